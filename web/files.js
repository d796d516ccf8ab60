// Which file is what, by its name.

/** The extensions of each kind, as the program has them in src/session/open/files.rs. "unread" are pictures that the viewer names and cannot read. A text is a model where it begins like one. */
export const KINDS = {
  model: ["m3d", "glb", "gltf", "fbx"],
  archive: ["zip"],
  picture: ["dds", "png", "jpg", "jpeg", "webp", "tga", "bmp", "hdr"],
  buffer: ["bin"],
  text: ["txt"],
  unread: ["exr"],
};

const isOf = (name, kinds) => kinds.some((kind) => KINDS[kind].includes(/\.([^./\\]*)$/.exec(name)?.[1].toLowerCase()));

/** Whether a viewer has a use for the file. The rest of a folder is left where it is. */
export const isUseful = (name) => isOf(name, Object.keys(KINDS));

/**
 * What was collected, without the notes of folders: a text may be a model, but beside pictures and without a model it is taken for notes. A path
 * with a folder in it is from one.
 */
export function withoutNotes(files) {
  const has = (...kinds) => files.some(({ name }) => isOf(name, kinds));
  if (!has("picture", "unread") || has("model", "archive")) return files;
  return files.filter(({ name }) => !name.includes("/") || !isOf(name, ["text"]));
}

/** Whether files can only join what is open: none of them can be a model. */
export const onlyJoins = (files) => files.length > 0 && files.every((file) => isOf(file?.webkitRelativePath || file?.name || "", ["picture", "unread"]));

/** What a dialog for files with clips offers, as `accept` takes it. */
export const CLIP_FILES = ["model", "archive", "buffer"].flatMap((kind) => KINDS[kind]).map((extension) => `.${extension}`).join();
