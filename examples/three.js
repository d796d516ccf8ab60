// Links between a sentence and a moment.

for (const link of document.querySelectorAll("a[data-secs]")) {
  link.addEventListener("click", () => {
    const viewer = document.querySelector(link.getAttribute("href"));
    viewer.pause();
    viewer.currentTime = Number(link.dataset.secs);
  });
}
