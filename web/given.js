// What the person gave the page, kept for another reading: files on disk may have changed since.

const MODEL = /\.(m3d|a3d)$/i;

/** Those that were there, but for the ones that come again under the same name, and these. */
const joined = (before, files) => [...before.filter(({ name }) => !files.some((file) => file.name === name)), ...files];

/** A `{name, file}` record with the file as it is now, where the page may ask for it again. */
const fresh = async (item) => ({ ...item, file: item.again ? await item.again() : item.file });

/** Keeps what is given until another model comes. */
export function rememberGiven() {
  let model = null; // The files that brought it.
  let beside = []; // Maps and skies that came later.
  let clips = []; // Files whose clips were added.
  return {
    add(files, addsClips) {
      if (addsClips) clips = joined(clips, files);
      else if (files.some(({ name }) => MODEL.test(name))) [model, beside, clips] = [files, [], []];
      else beside = joined(beside, files);
    },
    isEmpty: () => !model && !beside.length && !clips.length,
    hasModel: () => Boolean(model),
    /** All of it as it is now: what is opened, `own` in place of a model that was not given, and what adds its clips. */
    async readAgain(own) {
      const opened = model ? await Promise.all(model.map(fresh)) : await own();
      const rest = await Promise.all([beside, clips].map((files) => Promise.all(files.map(fresh))));
      return { files: [...(opened ?? []), ...rest[0]], clips: rest[1] };
    },
  };
}
