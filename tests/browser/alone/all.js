// The page's own scripts without a browser and without a viewer. `node --test tests/browser/alone/all.js`
import "./element.js";
import "./files.js";
import "./life.js";
import "./link.js";
import "./mirror.js";
