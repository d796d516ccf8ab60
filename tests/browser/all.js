// Every browser test, one after the other in one browser: they share two cores and a GPU made of software.
import "./page.js";
import "./opening.js";
import "./gltf.js";
import "./playing.js";
import "./keys.js";
import "./roles.js";
import "./skeleton.js";
import "./names.js";
import "./pictures.js";
import "./looking.js";
import "./subsets.js";
import "./moving.js";
import "./crowd.js";
import "./fingers.js";
import "./several.js";
import "./lasting.js";
import "./visits.js";
