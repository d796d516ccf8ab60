//! The table of codes that changes and losses of an export have beside those of findings: a sentence, and what to do.

/// A kind of change or loss.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExportCode {
    /// Stable kebab-case name, in no other table.
    pub name: &'static str,
    /// Whether something of the model is lost; otherwise it was asked for, or comes with the format.
    pub is_loss: bool,
    /// What is otherwise.
    pub sentence: &'static str,
    /// What to do about it.
    pub advice: &'static str,
}

/// The row with this name.
pub fn named(name: &str) -> Option<&'static ExportCode> {
    ALL.iter().find(|code| code.name == name)
}

const fn change(name: &'static str, sentence: &'static str, advice: &'static str) -> ExportCode {
    ExportCode {
        name,
        is_loss: false,
        sentence,
        advice,
    }
}

const fn loss(name: &'static str, sentence: &'static str, advice: &'static str) -> ExportCode {
    ExportCode {
        is_loss: true,
        ..change(name, sentence, advice)
    }
}

/// All rows: changes, then losses.
pub const ALL: &[ExportCode] = &[
    change(
        "clips-chosen",
        "Clips that were not chosen are left out.",
        "Name more of them with `--clips`.",
    ),
    change(
        "in-place",
        "A clip stays over where it starts.",
        "Leave out `--in-place` to keep its way over the ground.",
    ),
    change(
        "range-cut",
        "A part of a clip is kept, with keys at its cuts.",
        "Choose another part with `--range`.",
    ),
    change(
        "loop-closed",
        "The end of a clip is eased into its first pose.",
        "Leave out `--close-loop` to keep its end as it is.",
    ),
    change(
        "keys-reduced",
        "Keys are left out that hardly move anything; the message says how far joints are off.",
        "Give `--reduce` a smaller tolerance to keep more of them.",
    ),
    change(
        "scaled",
        "All lengths are multiplied by a factor.",
        "`--scale` says another factor, also with `--for-book`.",
    ),
    change("up-axis-changed", "Another axis is up.", "`--up` says which one."),
    change(
        "handedness-changed",
        "The space is mirrored: geometry, skeleton and keys together.",
        "`--hand` says which hand; the books' programs expect the default.",
    ),
    change(
        "winding-changed",
        "The corners of triangles go round the other way, so that their front faces stay in front.",
        "Nothing: it follows the hand.",
    ),
    change(
        "front-changed",
        "The model is turned round, to face where characters of the format do.",
        "Nothing: tools of the format expect it.",
    ),
    change("clip-renamed", "A clip has another name.", "`--rename` says which."),
    change("bone-renamed", "A bone has a name.", "`--rename-bone` says which."),
    change(
        "clip-shifted",
        "A clip begins at 0 s, where the books' demo begins.",
        "Nothing: its poses are the same.",
    ),
    change(
        "material-renamed",
        "A material has a name of one word.",
        "Use such names to keep them; the books' loaders end a name at a blank.",
    ),
    change(
        "bones-folded",
        "A bone that keeps still and moves nothing is taken out, where there are more than the books' demo has room for.",
        "Nothing: the bone below does what it did.",
    ),
    change(
        "materials-edited",
        "Materials are written as they were edited on the page.",
        "Undo the edits to write them as in the file.",
    ),
    change(
        "maps-written",
        "Pictures of materials are written beside the file.",
        "Put them where the program that reads the file looks for textures.",
    ),
    change(
        "maps-added",
        "Materials without a map get a plain one, since the books' demo opens two for each.",
        "Nothing: they look the same.",
    ),
    change(
        "metalness-from-picture",
        "Metalness and roughness that pictures have are written as their means, or metalness into the diffuse map.",
        "Write maps with `--textures-out`, and give metalness the texture coordinates of the base colour.",
    ),
    change(
        "normal-green-turned",
        "Green of normal maps points the other way, down in the books and up in glTF, and the tangents' sign with it.",
        "Use the pictures that are written, not those of the input.",
    ),
    change(
        "normal-green-flipped",
        "Green of normal maps is taken as it was chosen on the page.",
        "Choose the other direction to write it as in the file.",
    ),
    loss(
        "normal-green-up",
        "Normal maps have green up as in glTF, and their pictures are not written.",
        "Write them with `--textures-out`, which turns them.",
    ),
    loss(
        "maps-not-written",
        "Maps of the input are named and not written.",
        "Write them with `--textures-out`.",
    ),
    loss(
        "maps-missing",
        "Maps without a picture are left out of a `.glb`.",
        "Give the folder of the pictures with `--textures`, or drop them on the page.",
    ),
    loss(
        "maps-unreadable",
        "Pictures of maps are there and cannot be read.",
        "Write the pictures anew; `check --textures` says what is wrong with each.",
    ),
    loss(
        "texture-shear",
        "The transform of a map shears its texture coordinates (UVs), which that of glTF cannot.",
        "Apply the shear to the UV map in the modelling program.",
    ),
    loss(
        "subsets-empty",
        "Subsets without triangles are left out.",
        "Nothing: they show nothing.",
    ),
    loss(
        "vertices-unweighted",
        "Vertices that no bone moves hang on a joint that is added and stands still.",
        "Give them weights in the modelling program (a vertex group of a bone).",
    ),
    loss(
        "negative-times",
        "Keys before 0 s, which glTF does not have, are moved to begin there.",
        "Begin the clip at 0 s.",
    ),
    loss(
        "clips-without-keys",
        "Clips without keys are left out.",
        "Give at least one bone a key.",
    ),
    loss(
        "copyright",
        "The format has no line of copyright.",
        "Keep it in a file beside the model.",
    ),
    loss(
        "up-axis",
        "Another axis is up than where the format has it.",
        "Leave out `--up`, or give the one that the message names.",
    ),
    loss(
        "front",
        "The model faces the other way than characters of the format do.",
        "Let convert turn it, as it does by default.",
    ),
    loss(
        "vertex-colors",
        "The format has no colours of vertices.",
        "Bake them into a diffuse map.",
    ),
    loss(
        "second-tex-coords",
        "The format has one UV map (one set of texture coordinates).",
        "Bake the pictures that use the second UV map into ones for the first.",
    ),
    loss(
        "materials-left-out",
        "A `.txt` model has no materials.",
        "Write a `.m3d` or a `.glb`.",
    ),
    loss(
        "subsets-joined",
        "A `.txt` model has no subsets: all triangles are drawn with one material.",
        "Write a `.m3d` or a `.glb`.",
    ),
    loss(
        "tex-coords-left-out",
        "A `.txt` model has no texture coordinates.",
        "Write a `.m3d` or a `.glb`.",
    ),
    loss(
        "bones-left-out",
        "A `.txt` model has no bones, and its vertices no weights.",
        "Write a `.m3d` or a `.glb`.",
    ),
    loss(
        "clips-left-out",
        "A `.txt` model does not move.",
        "Write a `.m3d` or a `.glb`.",
    ),
    loss(
        "joint-names",
        "The format numbers its bones and has no names for them.",
        "Nothing: on the page names are kept beside the file.",
    ),
    loss(
        "rest-pose",
        "Bones rest elsewhere than in the bind pose (the edit mode's pose), which the format cannot say.",
        "Give them keys in each clip.",
    ),
    loss(
        "keys-united",
        "Translation, rotation and scale of a bone have keys at different times; the format has all three in each key.",
        "Nothing: the motion is the same.",
    ),
    loss(
        "step-keys",
        "Keys that hold their value (constant interpolation) become two keys each.",
        "Nothing: they look the same but for a moment before each jump.",
    ),
    loss(
        "cubic-keys",
        "Splines (Bézier interpolation) become straight pieces; the message says how far they are off.",
        "Nothing, or sample the curves in the modelling program.",
    ),
    loss(
        "materials-shared",
        "Subsets that share a material get a copy each, since the format has one material for each subset.",
        "Join the objects that share a material.",
    ),
    loss(
        "materials-unused",
        "Materials that no subset is drawn with are left out.",
        "Nothing: they are not seen.",
    ),
    loss(
        "names-of-one-word",
        "Blanks in names become underscores, since the books' loaders end a name at one.",
        "Use names without blanks.",
    ),
    loss(
        "material-names",
        "The dialect has no names of materials.",
        "Write the dialect d3d12 to keep them.",
    ),
    loss(
        "metallic-roughness",
        "The format has no metalness: a metal gets a darker colour and reflects (Fresnel0) in its own.",
        "Look at it in the book's light; edit diffuse, Fresnel0 and roughness on the page where it looks too dark.",
    ),
    loss(
        "metallic-roughness-map",
        "The format has no map of roughness and metalness (metallic-roughness, ORM); what became of it is told by `metalness-from-picture`.",
        "Put 1 − roughness into the alpha of the normal map, which the D3D12 book reads as gloss.",
    ),
    loss(
        "occlusion-map",
        "The format has no map of ambient occlusion (AO).",
        "Multiply it into the diffuse map.",
    ),
    loss(
        "emissive-map",
        "The format has no map of emission (glow).",
        "Add it to the diffuse map.",
    ),
    loss(
        "phong-to-fresnel",
        "Materials of the DirectX 11 book are said in the words of the other one.",
        "Write the dialect d3d11 to keep them.",
    ),
    loss(
        "fresnel-to-phong",
        "Materials are said in the words of the DirectX 11 book.",
        "Write the dialect d3d12 to keep them.",
    ),
    loss(
        "alpha-blend",
        "The format has no transparency by blending; the material is drawn opaque.",
        "Cut leaves and hair out by alpha instead (Alpha Clip, a mask).",
    ),
    loss(
        "alpha-cutoff",
        "The books cut holes at one alpha for all.",
        "Scale the alpha of the map.",
    ),
    loss(
        "opacity",
        "The format has no opacity (alpha) beside a colour.",
        "Put it into the alpha of the diffuse map.",
    ),
    loss(
        "double-sided",
        "The format cannot say whether back faces are drawn (two-sided, Backface Culling): the books draw those of what is cut out by alpha alone.",
        "Nothing where the backs are never seen, as of a closed body. Else duplicate the faces and flip the copies.",
    ),
    loss(
        "unlit",
        "The format has no materials without light (unlit, shadeless).",
        "Nothing: it is lit.",
    ),
    loss(
        "emissive",
        "The format has no emission, light that a material gives by itself.",
        "Use a brighter diffuse colour.",
    ),
    loss(
        "layers",
        "The format has no clear coat, sheen, transmission or specular map of a material. An index of refraction and a specular colour become Fresnel R0, of a specular map the number beside it alone.",
        "Nothing where the look is good without. A coat may become a smaller roughness, a sheen a brighter diffuse colour.",
    ),
    loss(
        "normal-scale",
        "The format has no strength of a normal map.",
        "Scale red and green of the picture.",
    ),
    loss(
        "map-sampling",
        "The books' maps repeat, by the first UV map as it is; the message names the map and what it has of another kind.",
        "Bake a picture of a second UV map into the first; apply a mapping's offset, turn and scale to the UV map.",
    ),
];
