// Where the interface is on the page. It is drawn on a canvas and has no elements to ask, so the places that the tests use
// are all here: points of a window of 960 × 600, with the sample open.

/** Bar at the top right. */
export const LIGHT_BUTTON = [636, 30];
export const TURNTABLE_BUTTON = [770, 30];

/** What hangs from the light's button. */
export const LIGHT_POPOVER = {
  split: [922, 140],
  passes: { shadow: [900, 388], reflections: [900, 416], contact: [900, 444], ao: [900, 472] },
};

/** Subsets in the panel on the left, once it is scrolled to its end: the eye of the orange parts. */
export const TRIM_EYE = [238, 452];

/** The name of the file, where there are several models; the last of three in its menu. */
export const FILE_MENU = [140, 30];
export const LAST_OF_THREE = [150, 131];

/** The panel's first page. */
export const MODEL_PAGE = [70, 87];
/** The panel's other page: its tree of bones, and in it the bone that hangs from the root. */
export const SKELETON_PAGE = [190, 87];
export const TREE = { x: 14, y: 140, width: 240, height: 300 };
export const SECOND_BONE = [90, 179];

/** The inspector on the right, as large as it is for a subset with maps. */
export const INSPECTOR = { x: 662, y: 62, width: 284, height: 386 };
export const ROUGHNESS_KNOB = [834, 285];
export const ROUGHNESS_LEAST = [766, 285];
export const RESET_MATERIAL = [918, 204];

/** The divided picture's handle, in the middle of the window. */
export const SPLIT_HANDLE = [480, 300];

/** The figure's chest, on its first frame: a part of its suit. */
export const CHEST = [500, 240];
/** Ground beside the figure that no panel covers. */
export const GROUND = [600, 510];

/** Bones of the figure on its first frame, by their numbers in the file: points on them beside other bones. */
export const BONES = { 19: [508, 318], 24: [452, 205], 4: [492, 195] };

/** The bar of the legend that explains the colours of the skin. */
export const LEGEND_BAR = { x: 25, y: 489, width: 220, height: 3 };

/** The bar with the keys in the strip: where its first and its last frame are, and what holds the ends of the range. */
export const TIME_BAR = { first: 328, last: 608, y: 561 };
export const RANGE_IN = [322, 561];
export const RANGE_OUT = [614, 561];

/** The clips, which hang from their button in the strip; the icon that blends the second into the first, and what it brings. */
export const CLIPS_BUTTON = [263, 561];
export const BLEND_SECOND_CLIP = [537, 332];
export const BLEND_KNOB = [408, 486];
export const BLEND_MOST = [520, 486];
export const BLEND_END = [540, 458];

/** The same bar on a phone, 390 × 844. */
export const PHONE_TIME_BAR = { first: 81, last: 311, y: 754 };
/** And on its side, 844 × 390, with the button of the dope sheet. */
export const LOW_TIME_BAR = { first: 283, last: 507, y: 352 };
export const LOW_SHEET_BUTTON = [806, 352];
