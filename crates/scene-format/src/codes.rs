//! The codes of all diagnostics: stable names, what each means, and how to mend it.
//!
//! `E01xx` syntax, `E02xx` structure, `E03xx` values, `E04xx` names, `E05xx` files, `W....` warnings. A code never
//! changes its meaning and is never given twice.

/// Constants of codes, and the list of their entries.
macro_rules! codes {
    ($LIST:ident: $( $(#[doc = $doc:literal])+ $NAME:ident $code:literal $title:literal; )+) => {
        $(
            #[doc = concat!($code, ": ", $title, ".\n")]
            $(#[doc = $doc])+
            pub const $NAME: Code = Code::new($code);
        )+

        pub(super) const $LIST: &[Entry] = &[
            $( Entry { code: $NAME, title: $title, text: concat!($($doc, "\n"),+) }, )+
        ];
    };
}

mod code;
mod warnings;

pub use code::{Code, Entry, explain, find};
pub use warnings::*;

/// All codes in order.
pub const CODES: &[Entry] = &{
    let mut all = [ERRORS[0]; ERRORS.len() + warnings::WARNINGS.len()];
    let mut k = 0;
    while k < all.len() {
        all[k] = if k < ERRORS.len() { ERRORS[k] } else { warnings::WARNINGS[k - ERRORS.len()] };
        k += 1;
    }
    all
};

codes! {
    ERRORS:
    /// At this place the language allows a value or a name, and what stands there begins neither. Often a comment sign
    /// of another syntax (`#` in RON, `//` in TOML, any in JSON), typographic quotes, or round brackets in TOML and
    /// JSON.
    ///
    /// ```ron
    /// Scene(objects: [Sphere(center: “0”, radius: 1)])
    /// ```
    UNEXPECTED_CHARACTER "E0101" "a character that means nothing here";
    /// A `(`, `[` or `{` has no closing partner. The mark stands at the bracket that was opened, the second mark where
    /// it was noticed: the missing bracket belongs somewhere between the two.
    ///
    /// ```ron
    /// Scene(objects: [Sphere(center: (0, 0, 0), radius: 1)]
    /// ```
    UNCLOSED_BRACKET "E0102" "a bracket is never closed";
    /// A closing bracket has no partner, or closes a bracket of another kind.
    ///
    /// ```ron
    /// Scene(objects: [Sphere(center: (0, 0, 0], radius: 1)])
    /// ```
    STRAY_BRACKET "E0103" "a closing bracket does not match";
    /// Two values stand side by side. Values in brackets are parted by commas; one after the last is allowed, but in
    /// JSON.
    ///
    /// ```ron
    /// Scene(objects: [Sphere(center: (0, 0, 0) radius: 1)])
    /// ```
    MISSING_COMMA "E0104" "a comma is missing";
    /// A name and its value are joined by `:` in RON and JSON and by `=` in TOML.
    ///
    /// ```ron
    /// Scene(objects: [Sphere(center = (0, 0, 0), radius: 1)])
    /// ```
    MISSING_COLON "E0105" "name and value are not joined";
    /// A value should stand here: after a name, or between two commas.
    ///
    /// ```ron
    /// Scene(objects: [Sphere(center: (0, 0, 0), radius: )])
    /// ```
    MISSING_VALUE "E0106" "a value is missing";
    /// A text or a comment begins and does not end. Texts end on the line they begin on.
    ///
    /// ```ron
    /// Scene(objects: [Sphere(center: (0, 0, 0), radius: 1, material: "red)])
    /// ```
    UNCLOSED_TEXT "E0107" "a text is never closed";
    /// After a backslash only a few letters mean something. A backslash itself is written `\\`; in paths write `/`, it
    /// works on every system.
    ///
    /// ```ron
    /// Scene(objects: [Mesh(file: "models\cat.obj")])
    /// ```
    BAD_ESCAPE "E0108" "an escape that means nothing";
    /// What begins like a number is none: two decimal points, a unit, a comma as decimal point.
    ///
    /// ```ron
    /// Scene(objects: [Sphere(center: (0, 0, 0), radius: 1.5.2)])
    /// ```
    BAD_NUMBER "E0109" "a number is malformed";
    /// Brackets stand inside brackets more than 128 deep. No scene needs that.
    TOO_DEEP "E0110" "brackets too deep";
    /// Names of materials stand between quotes: `{ "white": Diffuse() }`. In TOML a name of other characters than
    /// letters, digits, `_` and `-` needs them.
    ///
    /// ```ron
    /// Scene(materials: { red: Diffuse() }, objects: [Sphere(center: (0, 0, 0), radius: 1, material: "red")])
    /// ```
    KEY_NOT_QUOTED "E0111" "a name is not between quotes";
    /// The scene (or, in TOML, the line) was complete, and something follows.
    ///
    /// ```ron
    /// Scene(objects: [Sphere(center: (0, 0, 0), radius: 1)]) Scene()
    /// ```
    TEXT_AFTER_END "E0112" "text after the end";
    /// Scene files are UTF-8 text. The message says at which byte it stops being that; an editor can save the file as
    /// UTF-8.
    NOT_UTF8 "E0113" "the file is not UTF-8";
    /// Scene files may have 1 GiB. A scene of that size is better written with placements files beside it.
    TOO_LARGE "E0114" "the file is too large";
    /// `#![enable(..)]` names an extension of RON that scenes do not know. A scene needs none: remove the line.
    ///
    /// ```ron
    /// #![enable(unwrap_everything)]
    /// Scene(objects: [Sphere(center: (0, 0, 0), radius: 1)])
    /// ```
    UNKNOWN_EXTENSION "E0115" "an unknown RON extension";
    /// In one pair of brackets either every value has a name or none has.
    ///
    /// ```ron
    /// Scene(objects: [name: 1])
    /// ```
    MIXED_FIELDS "E0116" "named and unnamed values mixed";
    /// Two headers of a TOML file contradict each other.
    ///
    /// ```toml
    /// [camera]
    /// fov = 40
    /// [camera]
    /// fov = 50
    /// ```
    TABLE_CONFLICT "E0117" "a TOML table is written twice";
    /// In TOML every word is a text and stands between quotes, but for `true` and `false`.
    ///
    /// ```toml
    /// [render]
    /// acceleration = Bvh
    /// ```
    WORD_NOT_QUOTED "E0118" "a word is not between quotes";
    /// A value has no name where its neighbours have one, or a header or point has no name beside it.
    ///
    /// ```ron
    /// Scene(objects: [Sphere(center: (0, 0, 0), 1)])
    /// ```
    MISSING_NAME "E0119" "a name is missing";
    /// After a thousand faults the rest is not listed: mend the first ones, the others may go with them.
    TOO_MANY "E0120" "too many faults";
    /// Several numbers are parted by commas where one value stands. The numbers of a vector stand in brackets of their
    /// own: `(0, 0, 0)` in RON, `[0, 0, 0]` in TOML and JSON.
    ///
    /// ```ron
    /// Scene(objects: [Sphere(center: 0, 0, 0, radius: 1)])
    /// ```
    NO_BRACKETS "E0121" "a vector without brackets";
    /// `<<<<<<<`, `=======` and `>>>>>>>` at the beginnings of lines: `git merge` leaves both versions for you to
    /// choose from.
    ///
    /// ```ron
    /// Scene(
    /// <<<<<<< HEAD
    ///     background: 1,
    /// =======
    ///     background: 0.5,
    /// >>>>>>> darker
    ///     objects: [Sphere(center: (0, 0, 0), radius: 1)],
    /// )
    /// ```
    MERGE_CONFLICT "E0122" "a merge that was not finished";
    /// The file is written in another language: TOML under a name that says RON, YAML, or a scene of another
    /// program (POV-Ray, pbrt, Mitsuba). Only RON, TOML and JSON are read, each by its extension or by `--syntax`.
    OTHER_LANGUAGE "E0123" "a file in another language";

    /// This part of the scene has no field of this name. The message lists those it has, and the nearest when it looks
    /// like a typo.
    ///
    /// ```ron
    /// Scene(objects: [Sphere(center: (0, 0, 0), radus: 1)])
    /// ```
    UNKNOWN_FIELD "E0201" "an unknown field";
    /// A field without a default is not written.
    ///
    /// ```ron
    /// Scene(objects: [Sphere(center: (0, 0, 0))])
    /// ```
    MISSING_FIELD "E0202" "a field is missing";
    /// A value of another kind is needed: a number, a text, a vector ...
    ///
    /// ```ron
    /// Scene(objects: [Sphere(center: (0, 0, 0), radius: "big")])
    /// ```
    WRONG_TYPE "E0203" "a value of the wrong kind";
    /// A name before brackets, or a bare word, is none of those that are possible here.
    ///
    /// ```ron
    /// Scene(objects: [Ball(center: (0, 0, 0), radius: 1)])
    /// ```
    UNKNOWN_VARIANT "E0204" "an unknown kind";
    /// A field is written twice; nobody could tell which one counts.
    ///
    /// ```ron
    /// Scene(objects: [Sphere(center: (0, 0, 0), radius: 1, radius: 2)])
    /// ```
    DUPLICATE_FIELD "E0205" "a field is written twice";
    /// A vector has three numbers; a colour has three, or one for grey.
    ///
    /// ```ron
    /// Scene(objects: [Sphere(center: (0, 0), radius: 1)])
    /// ```
    WRONG_COUNT "E0206" "the wrong number of values";
    /// A scene without objects is a picture of nothing. One sphere is enough.
    ///
    /// ```ron
    /// Scene(objects: [])
    /// ```
    NO_OBJECTS "E0207" "the scene has no objects";
    /// The scene is written for a newer version of the language than this program knows. Nothing else is said about it,
    /// since the rest may mean something else there.
    ///
    /// ```ron
    /// Scene(version: 2, objects: [Sphere(center: (0, 0, 0), radius: 1)])
    /// ```
    NEWER_VERSION "E0208" "a newer version of the language";
    /// Something is written in one of several ways, and here in more than one or in none: the strength of a light, or
    /// the triangles of a mesh (`file`, or `points` with `faces`).
    ///
    /// ```ron
    /// Scene(
    ///     lights: [SphereLight(center: (0, 5, 0), radius: 1, intensity: 10, power: 100)],
    ///     objects: [Sphere(center: (0, 0, 0), radius: 1)],
    /// )
    /// ```
    EXACTLY_ONE "E0209" "exactly one of several fields";
    /// `repeat`, `keyframes`, `for` and `let` are kept for later versions of the language.
    ///
    /// ```ron
    /// Scene(repeat: 3, objects: [Sphere(center: (0, 0, 0), radius: 1)])
    /// ```
    RESERVED_WORD "E0210" "a word that is kept for later versions";
    /// `DropTo`, `CenterTo` or `FitTo` stands in the `transform` or the `placements` of a `Plane`, or of a `Group` or
    /// an `Include` in which one stands. It has no lowest point, no middle and no extent: move it by `Translate`, or
    /// take it out of the group.
    ///
    /// ```ron
    /// Scene(
    ///     background: 1,
    ///     objects: [Group(objects: [Plane(normal: (0, 1, 0))], transform: [DropTo(y: 0)])],
    /// )
    /// ```
    GROUP_DROP "E0211" "a plane that is dropped, centred or fitted";
    /// A field stands beside another one that leaves it nothing to say: a `fov` where a panorama shows all directions.
    ///
    /// ```ron
    /// Scene(camera: Camera(fov: 30, projection: Panorama), objects: [Sphere(center: (0, 0, 0), radius: 1)])
    /// ```
    NO_USE "E0212" "a field that has no use here";

    /// A length or size must be more than zero.
    ///
    /// ```ron
    /// Scene(objects: [Sphere(center: (0, 0, 0), radius: -1)])
    /// ```
    NOT_POSITIVE "E0301" "a value must be positive";
    /// A quantity such as light or blur can be zero, not less.
    ///
    /// ```ron
    /// Scene(background: -0.5, objects: [Sphere(center: (0, 0, 0), radius: 1)])
    /// ```
    NEGATIVE "E0302" "a value must not be negative";
    /// A value is outside the range that makes sense for it.
    ///
    /// ```ron
    /// Scene(camera: Camera(fov: 180), objects: [Sphere(center: (0, 0, 0), radius: 1)])
    /// ```
    OUT_OF_RANGE "E0303" "a value is out of range";
    /// `inf`, `NaN` and numbers beyond 1.8e308 are no positions, sizes or colours.
    ///
    /// ```ron
    /// Scene(objects: [Sphere(center: (0, NaN, 0), radius: 1)])
    /// ```
    NOT_FINITE "E0304" "a number is not finite";
    /// A count (pixels, samples, bounces) is a whole number.
    ///
    /// ```ron
    /// Scene(image: Image(width: 512.5), objects: [Sphere(center: (0, 0, 0), radius: 1)])
    /// ```
    NOT_WHOLE "E0305" "a whole number is needed";
    /// A colour as text is `"#rrggbb"`: six hexadecimal digits, sRGB.
    ///
    /// ```ron
    /// Scene(background: "blue", objects: [Sphere(center: (0, 0, 0), radius: 1)])
    /// ```
    BAD_COLOR "E0306" "a colour that cannot be read";
    /// A direction or an axis of length zero points nowhere.
    ///
    /// ```ron
    /// Scene(objects: [Mesh(file: "cat.obj", transform: [Rotate(axis: (0, 0, 0), degrees: 90)])])
    /// ```
    ZERO_DIRECTION "E0307" "a direction of length zero";
    /// The camera stands at the very point it looks at, so it has no direction.
    ///
    /// ```ron
    /// Scene(camera: Camera(position: (0, 0, 0), look_at: (0, 0, 0)), objects: [Sphere(center: (0, 0, 0), radius: 1)])
    /// ```
    CAMERA_IN_TARGET "E0308" "the camera looks at its own position";
    /// The camera looks along its `up` direction, so that nothing says which way up the picture is.
    ///
    /// ```ron
    /// Scene(camera: Camera(position: (0, 9, 0), look_at: (0, 0, 0)), objects: [Sphere(center: (0, 0, 0), radius: 1)])
    /// ```
    UP_ALONG_VIEW "E0309" "up is parallel to the view";
    /// A name or a path is an empty text.
    ///
    /// ```ron
    /// Scene(objects: [Mesh(file: "")])
    /// ```
    EMPTY_TEXT "E0310" "an empty text";

    /// An object names a material that `materials` does not have.
    ///
    /// ```ron
    /// Scene(objects: [Sphere(center: (0, 0, 0), radius: 1, material: "gold")])
    /// ```
    UNKNOWN_MATERIAL "E0401" "an unknown material";
    /// Two materials have the same name; nobody could tell which one is meant.
    ///
    /// ```ron
    /// Scene(
    ///     materials: { "red": Diffuse(), "red": Mirror() },
    ///     objects: [Sphere(center: (0, 0, 0), radius: 1, material: "red")],
    /// )
    /// ```
    DUPLICATE_NAME "E0402" "a name is given twice";
    /// The argument of `--set` names no field of the scene: `--set camera.fow=40`.
    BAD_SET_PATH "E0403" "--set names no field";
    /// The argument of `--set` is not of the form `path=value`, as in `--set camera.fov=40` or
    /// `--set 'materials.glass=Transparent(ior: 1.6)'`. The value is written in RON.
    BAD_SET_SYNTAX "E0404" "--set is not of the form path=value";
    /// The number in brackets in a `--set` path is beyond the end of the list: lists count from 0.
    BAD_SET_INDEX "E0405" "--set counts beyond the end of a list";
    /// A text where a colour is due names no texture: it is neither `"#rrggbb"` nor in `textures`. Or `vars` of an
    /// `Include` give a value to a name that the included scene has no var of. Write a name that there is.
    ///
    /// ```ron
    /// Scene(
    ///     textures: { "clouds": Noise(), "bricks": Lines() },
    ///     materials: { "sky": Diffuse(albedo: "clouds"), "wall": Diffuse(albedo: "briks") },
    ///     background: 1,
    ///     objects: [Box(material: "wall"), Sphere(center: (0, 2, 0), radius: 1, material: "sky")],
    /// )
    /// ```
    UNKNOWN_NAME "E0406" "an unknown texture, or var of an included scene";
    /// Values of `vars` need each other to be reckoned, textures are made of each other, or files include each other.
    ///
    /// ```ron
    /// Scene(vars: { "a": "=b+1", "b": "=2*a" }, background: 1, objects: [Sphere(center: (0, 0, 0), radius: "=a")])
    /// ```
    CIRCLE "E0407" "things that need each other";
    /// A name in `vars` cannot be used in an expression: it is no plain word, or a function's. Or the name of a texture
    /// begins with `#` or `=`: such a text is a colour, or an expression.
    ///
    /// ```ron
    /// Scene(vars: { "table height": 0.75 }, background: 1, objects: [Sphere(center: (0, 0, 0), radius: 1)])
    /// ```
    BAD_NAME "E0408" "a name that cannot be used";
    /// `camera`, or `--camera`, names a camera that the scene has none of in `cameras`.
    ///
    /// ```ron
    /// Scene(cameras: { "a": Camera() }, camera: "b", background: 1, objects: [Sphere(center: (0, 0, 0), radius: 1)])
    /// ```
    UNKNOWN_CAMERA "E0409" "an unknown camera";
    /// `output.masks` names what no object and no light is called. Names are given in the scene: `name: "lamp"`. That
    /// of a `Group` or an `Include` is not that of the objects in it.
    ///
    /// ```ron
    /// Scene(
    ///     background: 1,
    ///     objects: [Sphere(center: (0, 0, 0), radius: 1, name: "ball")],
    ///     output: Output(masks: ["bal"]),
    /// )
    /// ```
    UNKNOWN_MASK "E0410" "a mask of nothing";
    /// The scene has several `cameras`, and neither `camera` nor `--camera` says which one is meant. Who renders
    /// nothing (`check`, `fmt`, `convert`, editors) does without.
    ///
    /// ```ron
    /// Scene(cameras: { "a": Camera(), "b": Camera() }, background: 1, objects: [Sphere(center: (0, 0, 0), radius: 1)])
    /// ```
    UNDECIDED_CAMERA "E0411" "no camera is chosen";
    /// A `group` of lights has a name that no layer of a picture can have: too long, or `rest`, which is what the
    /// lights are called together that are of no group.
    ///
    /// ```ron
    /// Scene(
    ///     lights: [SphereLight(center: (0, 5, 5), radius: 1, power: 100, group: "rest")],
    ///     objects: [Sphere(center: (0, 0, 0), radius: 1)],
    /// )
    /// ```
    LIGHT_GROUP "E0412" "no name for a group of lights";
    /// A mesh, texture or placements file is not there. Paths are relative to the scene file.
    FILE_NOT_FOUND "E0501" "a file is not there";
    /// A file is there but cannot be read: a folder, or no permission.
    FILE_UNREADABLE "E0502" "a file cannot be read";
    /// A mesh file breaks the rules of its format (OBJ, OFF, PLY, STL, glTF or GLB). The message says where in the
    /// file and what was expected.
    BROKEN_MESH "E0510" "a mesh file is broken";
    /// A mesh file holds no triangle: there would be nothing to see. Look whether it is the right file, and whether it
    /// was exported with faces.
    EMPTY_MESH "E0511" "a mesh has no triangles";
    /// A glTF file says that it cannot be understood without an extension of the format, and this one is not known
    /// here: most often compression (`KHR_draco_mesh_compression`, `EXT_meshopt_compression`). Export the mesh again
    /// without it.
    GLTF_EXTENSION "E0513" "a glTF file requires an extension";
    /// The `part` of a `Mesh` is none of its file: an OBJ file has no object (`o`) and no group (`g`) of this name, or
    /// the scene of a glTF file has no node and no mesh; or the file is PLY, STL or OFF, whose files have no parts.
    /// Case counts. The message lists the names that there are.
    ///
    /// ```text
    /// Scene(background: 1, objects: [Mesh(file: "car.obj", part: "whel")])
    /// ```
    UNKNOWN_PART "E0514" "a part that a mesh file does not have";
    /// A material shows the colours of vertices (`VertexColor`), and the object that has it has none: it is no `Mesh`,
    /// its file has no colours, or it has `points` without `colors`. Of files OBJ (`v x y z r g b`), OFF, PLY and glTF
    /// may have colours, STL cannot.
    ///
    /// ```text
    /// Scene(background: 1, objects: [Sphere(radius: 1, center: (0, 0, 0), material: Diffuse(albedo: VertexColor()))])
    /// ```
    NO_VERTEX_COLORS "E0515" "colours of vertices that are not there";
    /// The picture of a texture or of a `HeightField` cannot be decoded as PNG, JPEG, HDR or EXR, or it is too large,
    /// too narrow, or has heights that are no numbers. Of an EXR file of several layers the first part with the
    /// channels R, G and B is taken, and of a file with one channel that, as grey; it is an error if there is neither.
    BROKEN_TEXTURE "E0520" "a picture cannot be read";
    /// A line of a placements file has 3 numbers (it moves by x, y, z), 4 (and scales by a factor), 8 (and turns about
    /// an axis by degrees) or 12 (a matrix of 3 rows and 4 columns), parted by blanks or commas. `#` begins a comment.
    ///
    /// ```text
    /// 0 0 0
    /// 2 0 0   0.5
    /// 4 0 0   1   0 1 0  45
    /// ```
    BROKEN_PLACEMENTS "E0530" "a placements file is broken";
    /// A transform squeezes a mesh to nothing: a scale of zero, or a chain of steps that comes to it.
    ///
    /// ```ron
    /// Scene(objects: [Mesh(file: "cat.obj", transform: [Scale(0)])])
    /// ```
    SINGULAR_TRANSFORM "E0540" "a transform that cannot be undone";
    /// The objects lie too far apart, or differ too much in size, for one picture: beyond the range of single precision
    /// once the scene is brought to its middle. Bring sizes and distances closer together.
    UNTRACEABLE "E0541" "a scene beyond the range of numbers";
    /// A shape without extent: a cylinder whose ends are one point, a disk whose hole is as large as itself.
    ///
    /// ```text
    /// Scene(background: 1, objects: [Disk(radius: 1, inner_radius: 1)])
    /// ```
    NO_EXTENT "E0542" "a shape without extent";
    /// A `Union`, an `Intersection` or a `Difference` takes closed shapes: `Sphere`, `Box`, `Cylinder` and `Cone` with
    /// caps, `Capsule`, `Torus`, and each other. What is open has no inside; what is made of triangles, and groups,
    /// cannot be part of one, nor can copies: `placements` of the whole make copies of it. A mesh, a `Lathe` or an
    /// `Extrude` is seen cut open by the camera's `near`: `camera: Camera(near: 4)` shows nothing that is nearer.
    ///
    /// ```ron
    /// Scene(background: 1, objects: [Difference(objects: [Box(size: 2), Disk(radius: 1)])])
    /// ```
    NO_OPERAND "E0543" "a shape that cannot be part of a solid";
    /// `Emissive` on a `Plane`, which has no end: nor would its light have one. Or `power`, `intensity`,
    /// `luminous_power` or `luminous_intensity` of a `Union`, an `Intersection`, a `Difference` or a shape in one:
    /// nobody knows how much of its surface is left. They shine by `radiance` or `luminance`.
    ///
    /// ```text
    /// Scene(objects: [Plane(material: Emissive(radiance: 5))])
    /// ```
    NO_LIGHT "E0544" "a shape that cannot shine";
    /// The rings of an `Extrude` meet themselves or each other, a hole is not within the first ring, or the points of a
    /// `Polygon` do not lie in one plane, or its sides cross. Points that repeat the last one are left out before that.
    ///
    /// ```ron
    /// Scene(background: 1, objects: [Extrude(outline: [[(0, 0), (1, 1), (1, 0), (0, 1)]], depth: 1)])
    /// ```
    BAD_OUTLINE "E0545" "an outline that bounds no face";
    /// The `matrix` of a camera turns and moves it, nothing else. Its columns are the directions to the right, upwards
    /// and backwards in the picture, and the eye. A scale, a shear or a mirroring in it has no meaning for a camera.
    ///
    /// ```text
    /// Scene(camera: Camera(matrix: ((2, 0, 0, 0), (0, 2, 0, 0), (0, 0, 2, 5))), objects: [..])
    /// ```
    CAMERA_MATRIX "E0546" "a matrix that is not a camera's";
    /// The picture of an `Environment` cannot be decoded as HDR, EXR, PNG or JPEG.
    BROKEN_ENVIRONMENT "E0552" "an environment cannot be read";
    /// A file that `include` or an `Include` names cannot be read, or `include` names one with objects: of a library
    /// `vars` and `materials` are taken. The objects of another scene come by `Include(file: ..)` among the objects.
    ///
    /// ```ron
    /// Scene(include: ["no such library.ron"], background: 1, objects: [Sphere(center: (0, 0, 0), radius: 1)])
    /// ```
    INCLUDE "E0560" "a file that cannot be included";

    /// An expression, a text that begins with `=`, is not written as expressions are: numbers, names from `vars`,
    /// `+ - * / % ^`, comparisons, functions, brackets.
    ///
    /// ```ron
    /// Scene(background: 1, objects: [Sphere(center: (0, "=2*(1+3", 0), radius: 1)])
    /// ```
    EXPRESSION_SYNTAX "E0601" "an expression that cannot be read";
    /// An expression uses a name that is neither in `vars` nor a function.
    ///
    /// ```ron
    /// Scene(vars: { "height": 2 }, background: 1, objects: [Sphere(center: (0, "=hight", 0), radius: "=height/4")])
    /// ```
    EXPRESSION_NAME "E0602" "an unknown name in an expression";
    /// An expression has a value of another kind than is needed there, or an operator or function does not take such
    /// values.
    ///
    /// ```ron
    /// Scene(background: 1, objects: [Sphere(center: (0, 0, 0), radius: "=(1, 2, 3)")])
    /// ```
    EXPRESSION_TYPE "E0603" "an expression of the wrong kind";
    /// A step of an expression gives infinity or no number at all: a division by zero, the root of a negative number.
    ///
    /// ```ron
    /// Scene(background: 1, objects: [Sphere(center: (0, 0, 0), radius: "=1/0")])
    /// ```
    EXPRESSION_NOT_FINITE "E0604" "an expression that is not finite";
    /// An expression asks for an item that a list does not have; items count from 0.
    ///
    /// ```ron
    /// Scene(vars: { "sizes": [1, 2, 4, 8] }, background: 1, objects: [Sphere(center: (0, 0, 0), radius: "=sizes[4]")])
    /// ```
    EXPRESSION_INDEX "E0605" "an item that a list does not have";

    /// Repetitions and includes make more than a scene can hold: ten million items, or more than eight within each
    /// other; groups stand more than sixteen deep, or a scene has more than a hundred million objects, copies counted;
    /// more than 256 files are included; or `vars` have more than sixteen lists within each other, or more than 64
    /// wait for each other. Or a `Union`, an `Intersection` or a `Difference` is made of more than 64 shapes:
    /// make several solids of it that stand side by side, each with the shapes that meet it (a wall of ten windows in
    /// five pieces), or a mesh in another program.
    TOO_MUCH "E0606" "repetitions or vars that make too much";
    /// Arithmetic stands where a number may stand, without quotes. Expressions are texts that begin with `=`.
    ///
    /// ```ron
    /// Scene(background: 1, objects: [Sphere(center: (0, 0, 0), radius: 1/3)])
    /// ```
    BARE_EXPRESSION "E0607" "an expression without quotes";
}
