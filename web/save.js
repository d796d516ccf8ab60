// Files for the person: saved as downloads.

/** How long a download may take to begin before its bytes are given up. */
const KEPT_MS = 60_000;

/** Saves bytes as a file of this name. */
export function saveFile(name, bytes, type) {
  const address = URL.createObjectURL(new Blob([bytes], { type }));
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), KEPT_MS);
}
