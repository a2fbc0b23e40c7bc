//! Codes of warnings.

use super::{Code, Entry};

codes! {
    WARNINGS:
    /// There is neither a light nor a background, or what lights there are shine with nothing: the picture will be
    /// black. Add a `SphereLight` to `lights`, an object with an `Emissive` material, or a `background`.
    ///
    /// ```ron
    /// Scene(objects: [Sphere(center: (0, 0, 0), radius: 1)])
    /// ```
    BLACK_PICTURE "W0301" "the picture will be black";
    /// A Blinn-Phong material, as the formula of the report has it, reflects more light than it gets: under light from
    /// everywhere up to albedo * (1 + 3 * specular) times as much, along its normal. The picture is what the formula
    /// says, but no real surface looks like it, and rooms full of it get too bright. `energy_conserving: true` takes
    /// the lobe that never does.
    ///
    /// ```text
    /// BlinnPhong(albedo: 0.9, exponent: 1000, specular: 0.5)                              // up to 2.24 times
    /// BlinnPhong(albedo: 0.9, exponent: 1000, specular: 0.5, energy_conserving: true)
    /// ```
    REFLECTS_MORE "W0302" "a material reflects more than it gets";
    /// A light, or the background, has less than 1e-37 of the radiance of the brightest one: single precision may not
    /// hold it beside the other. Bring the radiances closer together, or leave it out.
    LIGHT_TOO_DARK "W0303" "a light is too dark beside the others";
    /// `render.indirect: Map` asks for the map of indirect light that earlier versions had. It let light through walls
    /// and is gone; indirect light comes by paths. Leave the field out.
    MAP_IS_GONE "W0304" "there is no map of indirect light any more";
    /// A closed mesh of glass has its faces wound the other way, so that its inside is outside: light is bent the wrong
    /// way at it. Seen from outside, the corners of a face go round counterclockwise.
    INSIDE_OUT "W0305" "glass that is inside out";
    /// The camera stands inside a closed opaque object (a ball, a box, a closed mesh, a solid) in which there is no
    /// light: all that it sees is black.
    ///
    /// ```text
    /// Scene(background: 1, objects: [Sphere(center: (0, 0, 5), radius: 1)])
    /// ```
    CAMERA_SHUT_IN "W0306" "the camera is shut in";
    /// A light lies inside a closed opaque object (a ball, a box, a closed mesh, a solid), and the camera does not:
    /// none of its light gets out.
    ///
    /// ```text
    /// Scene(
    ///     lights: [SphereLight(center: (0, 0, 0), radius: 0.5, radiance: 10)],
    ///     objects: [Sphere(center: (0, 0, 0), radius: 1)],
    /// )
    /// ```
    LIGHT_SHUT_IN "W0307" "a light is shut in";
    /// The rendered picture is black: no light reaches what the camera sees, or so little that 99 of 100 pixels can
    /// hardly be told from black, or three quarters of those that are not of the background alone are dim, below 0.02
    /// of white. The message says which `exposure` would show it.
    ALL_BLACK "W0308" "the picture is black";
    /// The camera looks past all objects: all of them lie beside the view, or behind it, or the rendered picture shows
    /// nothing but the background.
    ///
    /// ```text
    /// Scene(
    ///     background: 1,
    ///     camera: Camera(position: (0, 0, 5), look_at: (0, 0, 9)),
    ///     objects: [Sphere(center: (0, 0, 0), radius: 1)],
    /// )
    /// ```
    NOTHING_IN_VIEW "W0309" "nothing is in view";
    /// `Transparent` on a shape that has no inside, a disk, a rectangle, a plane, a cylinder without caps or a mesh
    /// with holes: light is bent there once, and never back.
    ///
    /// ```text
    /// Scene(background: 1, objects: [Disk(material: Transparent(ior: 1.5))])
    /// ```
    OPEN_GLASS "W0310" "glass without an inside";
    /// A `Scatter` with `spacing` found no room for all of its copies: those that it found none for in 32 tries are
    /// left out. After 256 of them in a row no more are tried. Make the box larger, or `spacing` or `count` smaller.
    ///
    /// ```text
    /// placements: Scatter(count: 1000, min: (0, 0, 0), max: (1, 0, 1), spacing: 0.5)
    /// ```
    FEWER_COPIES "W0311" "fewer copies than asked for";
    /// The smooth curve through the points of a `Lathe` comes, between two of them, to less than half of their distance
    /// from the axis, or even to the axis, where it is cut off: a stem thins to nothing. A curve swings out where long
    /// and short distances between points meet. Add a point between the two.
    ///
    /// ```ron
    /// Scene(
    ///     background: 1,
    ///     objects: [Lathe(profile: [(0.2, 0), (0.05, 0.16), (0.05, 0.9), (0.2, 1)], curve: CatmullRom)],
    /// )
    /// ```
    THIN_PROFILE "W0312" "a curve that comes too near to its axis";
    /// The profile of a `Lathe` of glass crosses itself: what is inside of one part is outside of the other, and light
    /// is bent the wrong way there.
    ///
    /// ```ron
    /// Scene(
    ///     background: 1,
    ///     objects: [Lathe(profile: [(0, 0), (1, 1), (1, 0), (0, 1)], material: Transparent(ior: 1.5))],
    /// )
    /// ```
    CROSSED_GLASS "W0313" "glass whose profile crosses itself";
    /// The camera is so far away, and sees so little, that a pixel is smaller than the steps of single precision there:
    /// edges become stairs. Bring the camera nearer (a wider `fov` shows the same from there), or bring it nearer to
    /// the middle of the objects.
    ///
    /// ```text
    /// Scene(
    ///     camera: Camera(position: (0, 0, 10000000), look_at: (0, 0, 0), fov: 0.00001),
    ///     background: 1,
    ///     objects: [Sphere(center: (0, 0, 0), radius: 1)],
    /// )
    /// ```
    FAR_VIEW "W0314" "a view so far that single precision shows";
    /// A `Rectangle` or a `Disk` shines to one side, to which there is nothing: no object, and not the camera. All of
    /// its light is lost. Turn it round, or let it shine to both sides.
    ///
    /// ```text
    /// Scene(
    ///     background: 1,
    ///     objects: [
    ///         Sphere(center: (0, 0, 0), radius: 1),
    ///         Rectangle(center: (0, 9, 0), normal: (0, 1, 0), size: 1, material: Emissive(radiance: 5)),
    ///     ],
    /// )
    /// ```
    UNSEEN_LIGHT "W0315" "light that nobody sees";
    /// Spheres, cylinders, cones or capsules lie in one place, as a `Repeat` makes them whose items do not go by its
    /// index. One of them is seen: what shines, else what lets no light through, else the first; the others are left
    /// out.
    ///
    /// ```text
    /// Repeat(count: 5, items: [Sphere(center: (0, 0, 0), radius: 1)])
    /// ```
    IN_ONE_PLACE "W0316" "shapes in one place";
    /// A number is surely meant on another scale. A background whose channels are whole numbers up to 255, different
    /// and one of them above 100, is a colour in bytes: write it as `"#87ceeb"`. So is light whose channels are
    /// whole numbers, different, the largest of them 255. A `fov` from 0.2 to 2 that is no half or whole number, and
    /// `degrees` that are pi, a half, a third, a quarter or a sixth of it or a multiple of these, are radians. An
    /// `aperture` that is an f-number, as 2.8, and more than a fifth of the way to what is sharp, is a lens as wide as
    /// that; so is one that is wider than the way. An `exposure` above 10 is in stops, which double what is seen each,
    /// and makes a background more than 500 times as bright as white. A `focal_length` below 1 is in metres. An `up`
    /// within ten degrees of the view turns the picture by chance: y is up here. `random(-1, 1)` is no range: its
    /// numbers are seeds, which give one number from 0 to 1. Objects that are seen in three by three pixels, all of
    /// them, are in other units than the camera's place.
    ///
    /// ```ron
    /// Scene(background: (135, 206, 235), objects: [Sphere(center: (0, 0, 0), radius: 1)])
    /// ```
    OTHER_SCALE "W0317" "a number on another scale";
    /// The rendered picture is white: three quarters of its pixels and more are twice as bright as white in all
    /// channels, or three quarters of those that are not of the background alone; or in a quarter of these a channel is
    /// brighter than 1.25, so that their colours are others than they should be. Take a darker background or lights, or
    /// a lower `exposure`; the message says which.
    ALL_WHITE "W0318" "the picture is white";
    /// A `Rectangle` or `Box` lies in one plane with others that are seen in its place, all of it: a rug at the
    /// height of the floor. Of surfaces in one plane what shines is seen, then what lets no light through, then what
    /// comes first.
    ///
    /// ```text
    /// objects: [Rectangle(size: 6), Rectangle(size: 2, material: Diffuse(albedo: (0.8, 0.1, 0.1)))]
    /// ```
    HIDDEN_FLAT "W0319" "a flat thing that another one hides";
    /// A lamp shines with nothing, while others give light: its amount is 0, or its colour black. Give it light, or
    /// leave it out. What an expression or `--set` says may be nothing: a lamp that is off for once.
    ///
    /// ```text
    /// Scene(
    ///     background: 1,
    ///     lights: [SphereLight(center: (0, 5, 0), radius: 1, power: 0)],
    ///     objects: [Sphere(center: (0, 0, 0), radius: 1)],
    /// )
    /// ```
    DARK_LAMP "W0320" "a lamp that gives no light";
    /// Two bodies share a round wall: water that is exactly as wide as the glass is within, a shining band exactly as
    /// wide as the pillar that it is about. Rays meet both walls in one place, and rounding decides in which order:
    /// what is seen there is too dark or too bright, or a lamp lights that nobody sees. Let the one reach a little into
    /// the other, a hundredth of its size, or leave a gap. (Flat sides may touch.)
    ///
    /// ```text
    /// objects: [
    ///     Difference(
    ///         objects: [
    ///             Cylinder(from: (0, 0, 0), to: (0, 1, 0), radius: 0.5),
    ///             Cylinder(from: (0, 0.1, 0), to: (0, 1.1, 0), radius: 0.4),
    ///         ],
    ///         material: Transparent(ior: 1.5),
    ///     ),
    ///     Cylinder(from: (0, 0.1, 0), to: (0, 0.7, 0), radius: 0.4, material: Transparent(ior: 1.33)),
    /// ]
    /// ```
    SHARED_WALL "W0321" "bodies that share a wall";
    /// The rendered picture is black where more is to be seen in mirrors or through glass: one in a hundred samples and
    /// more were ended by `max_bounces` before they had met anything else. Each mirror and each side of glass is a
    /// bounce: a drink in a glass has eight sides. Set `max_bounces` higher; the message says how high. (Rays that are
    /// caught between mirrors without any loss are ended by nothing else. Who asks for no bounce or one has meant it.)
    ///
    /// ```text
    /// Scene(render: Render(max_bounces: 3), background: 1, objects: [
    ///     Sphere(center: (0, 0, 0), radius: 1, material: Transparent(ior: 1.5)),
    ///     Sphere(center: (0, 0, 0), radius: 0.8, material: Transparent(ior: 1)),
    /// ])
    /// ```
    CUT_PATHS "W0322" "ended where more is to be seen";
    /// Nothing is left of an `Intersection` or a `Difference`: its parts have no place in common, or what is taken away
    /// covers the first part. Lines through its box have met nothing (4096 of them). Write `Union` in its place for
    /// once to see where its parts are.
    ///
    /// ```text
    /// objects: [
    ///     Intersection(objects: [Sphere(center: (0, 0, 0), radius: 1), Sphere(center: (2, 1, 0), radius: 1)]),
    ///     Difference(objects: [Box(size: 1), Sphere(center: (0, 0, 0), radius: 2)]),
    /// ]
    /// ```
    NOTHING_LEFT "W0323" "a solid of which nothing is left";
    /// A `Difference` takes something away from where its first part is not, so it changes nothing. Move it there, or
    /// leave it out. Of copies by `Repeat` some may lie beside it.
    ///
    /// ```text
    /// objects: [
    ///     Difference(objects: [
    ///         Box(size: 1),
    ///         Cylinder(from: (2, -1, 0), to: (2, 1, 0), radius: 0.25),
    ///     ]),
    /// ]
    /// ```
    TAKES_NOTHING "W0324" "something is taken away where nothing is";
    /// An object or a lamp lies wholly behind a `Plane` that nobody sees through, as the camera sees it: a ball at
    /// `y: -1` under a floor at 0. (`y` is up; a ball that lies on the floor has its center one radius above.) Lift it,
    /// or leave it out. What moves while the shutter is open is not looked at.
    ///
    /// ```text
    /// objects: [Plane(), Sphere(center: (0, -2, 0), radius: 1)]
    /// ```
    BEHIND_PLANE "W0325" "something behind a plane";
    /// One square of a `Checkerboard` covers all of a thing, so that `b` is not seen: its squares lie by texture
    /// coordinates, one square a unit, and these go from 0 to 1 over a sphere, a cylinder or each face of a box.
    /// `mapping: Uv(scale: 8)` puts eight along each side; `mapping: Object(scale: 2)` makes cubes in space.
    ///
    /// ```ron
    /// Scene(background: 1, objects: [Box(size: 1, material: Diffuse(albedo: Checkerboard()))])
    /// ```
    SINGLE_SQUARE "W0326" "a checkerboard of one square";
    /// A material has a name that no object uses. Remove it, or use it.
    ///
    /// ```ron
    /// Scene(
    ///     background: 1,
    ///     materials: { "red": Diffuse() },
    ///     objects: [Sphere(center: (0, 0, 0), radius: 1)],
    /// )
    /// ```
    UNUSED_MATERIAL "W0401" "a material is not used";
    /// A name in `vars` that no expression uses, or a texture that no colour of a material and no other texture names.
    /// Remove it, or use it.
    ///
    /// ```ron
    /// Scene(vars: { "height": 2 }, background: 1, objects: [Sphere(center: (0, 0, 0), radius: 1)])
    /// ```
    UNUSED_NAME "W0402" "a var or a texture is not used";
    /// An expression asks for `frame` or `time`, and the scene has no `animation`, so that both are 0. Or the camera
    /// has a `shutter`, and no expression asks for `time`, so that nothing is blurred by motion. Or there is an
    /// `animation` of several frames, and no expression asks for either, so that all are one picture.
    ///
    /// ```ron
    /// Scene(background: 1, objects: [Sphere(center: ("=time", 0, 0), radius: 1)])
    /// ```
    NOTHING_MOVES "W0403" "time does not go by";
    /// `output.light_groups` asks for what each group of lights brings to the picture, and no light is of one: the only
    /// layer is that of the rest, which is the picture. Write a `group` in lights, in an `Emissive` or in the
    /// `Environment`.
    ///
    /// ```ron
    /// Scene(
    ///     output: Output(light_groups: true),
    ///     background: 1,
    ///     objects: [Sphere(center: (0, 0, 0), radius: 1)],
    /// )
    /// ```
    NO_LIGHT_GROUP "W0404" "groups of lights, and no light is of one";
    /// A mesh has oddities that were mended: triangles without area, points and lines, missing normals. They are
    /// counted.
    MESH_ODDITIES "W0510" "oddities in a mesh";
    /// The materials of a mesh's own file (MTL, glTF) say things that this renderer cannot do: they are taken as far as
    /// there is something like them here. A `material` in the scene replaces them.
    MTL_UNSUPPORTED "W0511" "a mesh's own materials say more than can be done";
    /// A glTF file has more than meshes that stand still: skins, morph targets, animations, extensions that it can be
    /// read without. The mesh is taken without them, as its nodes place it.
    GLTF_UNSUPPORTED "W0512" "a glTF file has more than meshes that stand still";
    /// The picture of an `Environment` is not twice as wide as it is high. It is laid around the scene all the same;
    /// pictures of other layouts (a cube's sides, a mirror ball) look wrong so.
    ENVIRONMENT_SHAPE "W0513" "an environment of another shape";
    /// A texture has transparent pixels. Its colours are used, its transparency is not. Or its transparency is all that
    /// counts, `channel: Alpha`, and it has none.
    TEXTURE_ALPHA "W0520" "transparency of a texture is ignored";
    /// A mesh has a material with a picture, or a pattern, that lies by texture coordinates, and its file none: every
    /// point of it has the colour of one corner. A pattern with `mapping: Object()` needs none.
    NO_COORDINATES "W0521" "a texture on a mesh without texture coordinates";
    /// Texels of an HDR or EXR picture on a surface are above 1 or below 0, and are clipped, or are no numbers, and are
    /// black: a surface reflects no more than it gets. Divide by the largest, or take the picture as an `Environment`
    /// if it is one.
    TEXTURE_CLIPPED "W0522" "texels beyond 0 to 1";
    /// Pixels of an `Environment` are below zero or not numbers: these are taken as black. Infinite ones are taken as
    /// the largest number of a half, 65504.
    ENVIRONMENT_PIXELS "W0552" "pixels of an environment that no light can have";
}
