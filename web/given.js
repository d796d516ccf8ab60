// What the person gave the page, kept for another reading: files on disk may have changed since.

const MODEL = /\.(m3d|a3d)$/i;

/** Those that were there, but for the ones that come again under the same name, and these. */
const joined = (before, files) => {
  const names = new Set(files.map(({ name }) => name));
  return [...before.filter(({ name }) => !names.has(name)), ...files];
};

/** `{name, file}` records with the files as they are now, where the page may ask for them again. */
export const freshly = (files) =>
  Promise.all(files.map(async (item) => ({ ...item, file: item.again ? await item.again() : item.file })));

/** Keeps what is given until another model comes, and what was refused until something is not. */
export function rememberGiven() {
  let model = null; // The files that brought it.
  let beside = []; // Maps and skies that came later.
  let clips = []; // Files whose clips were added.
  let refused = null; // What came last and could not be opened: on disk it may be mended.
  return {
    add(files, addsClips, opened) {
      refused = opened ? null : { files, addsClips };
      if (!opened) return;
      if (addsClips) clips = joined(clips, files);
      else if (files.some(({ name }) => MODEL.test(name))) [model, beside, clips] = [files, [], []];
      else beside = joined(beside, files);
    },
    forget: () => ([model, beside, clips, refused] = [null, [], [], null]),
    refused: () => refused,
    hasModel: () => Boolean(model),
    /** All of it as it is now: what is opened, `own` in place of a model that was not given, and what adds its clips. */
    async readAgain(own) {
      const opened = model ? await freshly(model) : await own();
      const rest = await Promise.all([beside, clips].map(freshly));
      return { files: [...(opened ?? []), ...rest[0]], clips: rest[1] };
    },
  };
}
