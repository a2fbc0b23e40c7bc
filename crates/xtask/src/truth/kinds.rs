//! The kinds of scenes that are drawn, each with everything else about it left to chance.

use super::draw::{self, once_in, one_of};
use super::meshes::{Point, Shape};
use super::receivers;
use super::relation::{PLANE_MIRROR, Relation};
use super::world::{World, glass, matt, mirror};
use scene_format::desc::{Albedo, Material, Mirror, Object, SolidMapping, StereoLayout, Transform};
use tracer_reference::Random;

/// A scene and what it is held against.
#[derive(Clone, Debug)]
pub struct Case {
    /// The seed that drew it.
    pub seed: u64,
    /// What kind of scene it is.
    pub kind: &'static str,
    /// The scene.
    pub world: World,
    /// What is true of it.
    pub relation: Relation,
    /// Light is hard to find here, so squares would show.
    pub hard: bool,
}

/// A room: half its width, its height, half its depth. The floor is y = 0.
#[derive(Clone, Copy, Debug)]
struct Room {
    half: f64,
    height: f64,
    deep: f64,
}

/// Walls are solid: this thick or more.
const WALL: f64 = 0.1;

impl Room {
    fn draw(random: &mut Random) -> Self {
        Room { half: random.between(2.0, 3.5), height: random.between(2.5, 4.0), deep: random.between(2.0, 3.5) }
    }

    /// Floor, ceiling and walls but those left out: 0 left, 1 right, 2 floor, 3 ceiling, 4 far, 5 near.
    fn walls(self, world: &mut World, without: &[usize], random: &mut Random) {
        let (w, h, d, t) = (self.half, self.height, self.deep, WALL);
        let blocks = [
            ([-w - t, -t, -d - t], [-w, h + t, d + t]),
            ([w, -t, -d - t], [w + t, h + t, d + t]),
            ([-w, -t, -d - t], [w, 0.0, d + t]),
            ([-w, h, -d - t], [w, h + t, d + t]),
            ([-w, 0.0, -d - t], [w, h, -d]),
            ([-w, 0.0, d], [w, h, d + t]),
        ];
        for (k, (low, high)) in blocks.into_iter().enumerate().filter(|(k, _)| !without.contains(k)) {
            let material = if k == 2 { draw::matt(world, random) } else { draw::wall(random) };
            world.mesh("wall", &Shape::block(low, high), material);
        }
    }

    /// A wall across the room at x, with a hole from `[z, y]` to `[z, y]`; without one if that is empty.
    fn partition(self, world: &mut World, x: f64, thick: f64, hole: Option<[[f64; 2]; 2]>, material: Material) {
        let (h, d) = (self.height, self.deep);
        // A little into the walls, so that no edge is open.
        let (low, high) = ([-d - 0.05, -0.05], [d + 0.05, h + 0.05]);
        let mut block = |[z0, y0]: [f64; 2], [z1, y1]: [f64; 2]| {
            if z1 > z0 && y1 > y0 {
                world.mesh("partition", &Shape::block([x, y0, z0], [x + thick, y1, z1]), material.clone());
            }
        };
        match hole {
            None => block(low, high),
            Some([[z0, y0], [z1, y1]]) => {
                block(low, [z0, high[1]]);
                block([z1, low[1]], high);
                block([z0, low[1]], [z1, y0]);
                block([z0, y1], [z1, high[1]]);
            }
        }
    }

    /// Somewhere in it, from `low` to `high` of its width.
    fn place(self, low: f64, high: f64, random: &mut Random) -> Point {
        let x = self.half * random.between(low, high);
        [x, self.height * random.between(0.15, 0.85), self.deep * random.between(-0.8, 0.6)]
    }

    /// A camera near the near wall, that looks at something on the floor.
    fn camera(self, world: &mut World, low: f64, high: f64, random: &mut Random) {
        let eye = [
            self.half * random.between(low, high),
            self.height * random.between(0.3, 0.7),
            self.deep * random.between(0.75, 0.95),
        ];
        let at = [self.half * (low + high) / 2.0, self.height * random.between(0.1, 0.3), -0.3 * self.deep];
        world.camera(eye, at, random.between(45.0, 85.0));
    }
}

/// One to three receivers on the floor, in this part of the room's width.
fn receivers(world: &mut World, room: Room, low: f64, high: f64, random: &mut Random) {
    for _ in 0..1 + random.below(3) {
        let kind = one_of(random, &receivers::ALL);
        let at = [room.half * random.between(low, high), 0.0, room.deep * random.between(-0.6, 0.3)];
        let scale = random.between(0.5, 1.0);
        kind.add_somehow(world, scale, at, random);
    }
}

/// Things of any material, anywhere.
fn things(world: &mut World, room: Room, most: usize, casters: bool, random: &mut Random) {
    for _ in 0..random.below(most + 1) {
        let place = room.place(-0.8, 0.8, random);
        let material = if casters { draw::caster(world, random) } else { draw::matt(world, random) };
        let size = random.between(0.15, 0.7);
        draw::thing(world, place, size, material, random);
    }
}

fn plain_room(world: &mut World, random: &mut Random) {
    let room = Room::draw(random);
    room.walls(world, &[], random);
    receivers(world, room, -0.7, 0.7, random);
    things(world, room, 3, false, random);
    for _ in 0..1 + random.below(3) {
        let place = room.place(-0.7, 0.7, random);
        draw::lamp(world, place, 0.4, random);
    }
    room.camera(world, -0.7, 0.7, random);
}

/// A room, and a lamp of any brightness in a black ball beside it, of which nothing gets out.
fn shut_in_lamp(world: &mut World, random: &mut Random) {
    if once_in(random, 2) {
        casters(world, random)
    } else {
        plain_room(world, random)
    }
    let (direction, away) = (random.direction(), random.between(12.0, 30.0));
    let (at, radius) = (direction.to_array().map(|x| away * x), random.between(0.1, 1.0));
    world.lamp(at, radius, [draw::magnitude(random, 1.0, 1e12); 3]);
    world.sphere(at, 1.2 * radius, matt(0.0));
}

fn casters(world: &mut World, random: &mut Random) {
    plain_room(world, random);
    let room = Room { half: 2.0, height: 2.5, deep: 2.0 };
    for _ in 0..1 + random.below(2) {
        things(world, room, 2, true, random);
        let place = room.place(-0.8, 0.8, random);
        let material = draw::caster(world, random);
        let size = random.between(0.2, 0.7);
        draw::thing(world, place, size, material, random);
    }
}

/// Puts a bulb about a lamp, or one in another.
fn bulb(
    world: &mut World,
    center: Point,
    lamp: f64,
    material: impl Fn(&mut World, &mut Random) -> Material,
    random: &mut Random,
) {
    let mut radius = lamp * random.between(1.05, 4.0);
    for _ in 0..1 + random.below(2) {
        let material = material(world, random);
        if once_in(random, 3) {
            // The inscribed ball of this mesh has four fifths of its radius: the lamp stays inside.
            let shape = Shape { normals: Vec::new(), ..Shape::ball(1) }.placed(radius / 0.8, center);
            world.mesh("bulb", &shape, material);
        } else {
            world.sphere(center, radius, material);
        }
        radius *= random.between(1.3, 1.8);
    }
}

fn bulbs(world: &mut World, random: &mut Random) {
    let room = Room::draw(random);
    room.walls(world, &[], random);
    receivers(world, room, -0.7, 0.7, random);
    for _ in 0..1 + random.below(2) {
        let place = room.place(-0.6, 0.6, random);
        let lamp = draw::lamp(world, place, 0.3, random);
        bulb(world, place, lamp, draw::clear, random);
    }
    room.camera(world, -0.7, 0.7, random);
}

/// A pane before the camera, or before half of the room; or glass cases about the things.
fn panes(world: &mut World, random: &mut Random) {
    let room = Room::draw(random);
    room.walls(world, &[], random);
    receivers(world, room, -0.7, 0.7, random);
    let place = room.place(-0.6, 0.6, random);
    draw::lamp(world, place, 0.4, random);
    room.camera(world, -0.6, 0.6, random);
    let (w, h, d) = (room.half, room.height, room.deep);
    match random.below(3) {
        0 => {
            let z = d * random.between(0.4, 0.7);
            let glass = draw::clear(world, random);
            world.mesh("pane", &Shape::block([-w, 0.0, z], [w, h, z + 0.03]), glass);
        }
        1 => {
            let x = w * random.between(-0.4, 0.4);
            let glass = draw::clear(world, random);
            world.mesh("pane", &Shape::block([x, 0.0, -d], [x + 0.05, h, 0.9 * d]), glass);
        }
        _ => {
            // A vitrine: glass around air cannot be said with an index below one, so five panes.
            let material = draw::clear(world, random);
            let (a, y, t) = (random.between(1.0, 1.4), random.between(1.0, 1.5), 0.03);
            for (low, high) in [
                ([-a, 0.0, -a], [-a + t, y, a]),
                ([a - t, 0.0, -a], [a, y, a]),
                ([-a + t, 0.0, -a], [a - t, y, -a + t]),
                ([-a + t, 0.0, a - t], [a - t, y, a]),
                ([-a, y + 0.001, -a], [a, y + t, a]),
            ] {
                world.mesh("vitrine", &Shape::block(low, high), material.clone());
            }
        }
    }
}

/// What is seen, or lit, in a flat mirror.
fn mirrors(world: &mut World, random: &mut Random) {
    let room = Room::draw(random);
    room.walls(world, &[], random);
    receivers(world, room, -0.7, 0.7, random);
    things(world, room, 2, true, random);
    let place = room.place(-0.6, 0.6, random);
    draw::lamp(world, place, 0.4, random);
    room.camera(world, -0.6, 0.6, random);
    let (w, h, d) = (room.half, room.height, room.deep);
    let corners = match random.below(3) {
        0 => [[-w + 0.02, 0.2, d], [-w + 0.02, 0.2, -d], [-w + 0.02, 0.9 * h, -d], [-w + 0.02, 0.9 * h, d]],
        1 => [[-w, 0.2, -d + 0.02], [w, 0.2, -d + 0.02], [w, 0.9 * h, -d + 0.02], [-w, 0.9 * h, -d + 0.02]],
        _ => [[-w, 0.01, d], [w, 0.01, d], [w, 0.01, -d], [-w, 0.01, -d]],
    };
    world.mesh("mirror", &Shape::quad(corners), Material::Mirror(Mirror { reflectance: draw::color(random).into() }));
    if once_in(random, 2) {
        // The camera looks into it.
        world.desc.camera.look_at = corners[0].map(|x| 0.5 * x).into();
    }
}

/// Two rooms, the camera's without a lamp; between them a slit, a hole, or nothing.
fn two_rooms(world: &mut World, hole: impl Fn(Room, &mut Random) -> Option<[[f64; 2]; 2]>, random: &mut Random) {
    let room = Room::draw(random);
    room.walls(world, &[], random);
    let thick = draw::magnitude(random, 0.01, 0.3);
    let hole = hole(room, random);
    let wall = draw::wall(random);
    room.partition(world, 0.0, thick, hole, wall);
    receivers(world, room, -0.7, -0.4, random);
    if once_in(random, 2) {
        receivers(world, room, 0.4, 0.7, random);
    }
    let place = room.place(0.4, 0.8, random);
    let lamp = draw::lamp(world, place, 0.25, random);
    if once_in(random, 4) {
        bulb(world, place, lamp, |_, _| glass(1.5), random);
    }
    if once_in(random, 3) && hole.is_some() {
        // A dim lamp in the dim room.
        world.lamp(room.place(-0.8, -0.4, random), 0.1, [0.3; 3]);
    }
    room.camera(world, -0.9, -0.3, random);
}

fn door_ajar(world: &mut World, random: &mut Random) {
    let ajar = |room: Room, random: &mut Random| {
        let z = room.deep * random.between(-0.9, 0.2);
        Some([[z, 0.0], [z + random.between(0.05, 0.5), room.height * random.between(0.6, 0.9)]])
    };
    two_rooms(world, ajar, random);
}

fn pinhole(world: &mut World, random: &mut Random) {
    let hole = |room: Room, random: &mut Random| {
        let ([z, y], size) = ([0.0, 0.4 * room.height], random.between(0.06, 0.3));
        Some([[z - size, y - size], [z + size, y + size]])
    };
    two_rooms(world, hole, random);
}

fn dark_room(world: &mut World, random: &mut Random) {
    if once_in(random, 3) {
        return super::dark_shell::dark_shell(world, random);
    }
    two_rooms(world, |_, _| None, random);
    if once_in(random, 3) {
        // Glass and mirrors in the dark find no light either.
        let material = draw::caster(world, random);
        world.sphere([-1.0, 1.0, 0.0], 0.3, material);
    }
}

/// Light from the sky through a small window.
fn small_window(world: &mut World, random: &mut Random) {
    let room = Room::draw(random);
    room.walls(world, &[1], random);
    let (z, y) = (room.deep * random.between(-0.5, 0.3), room.height * random.between(0.4, 0.6));
    let [a, b] = [0; 2].map(|_| random.between(0.15, 0.7));
    let wall = draw::wall(random);
    room.partition(world, room.half, WALL, Some([[z - a, y - b], [z + a, y + b]]), wall);
    receivers(world, room, -0.7, 0.7, random);
    world.desc.background = draw::background(world, random).scaled(5.0);
    if once_in(random, 2) {
        world.mesh("pane", &Shape::block([room.half, y - b, z - a], [room.half + 0.02, y + b, z + a]), glass(1.5));
    }
    room.camera(world, -0.9, 0.2, random);
}

/// A lamp in a box that is open at the top, or behind slats.
fn hidden_lamp(world: &mut World, random: &mut Random) {
    let room = Room::draw(random);
    room.walls(world, &[], random);
    receivers(world, room, -0.7, 0.7, random);
    let at = [room.half * random.between(-0.5, 0.5), 1.2, -0.3];
    let lamp = draw::lamp(world, at, 0.2, random);
    let wall = draw::wall(random);
    let s = lamp * random.between(1.2, 2.5);
    if once_in(random, 2) {
        for (low, high) in [
            ([-s - 0.03, -s, -s], [-s, s, s]),
            ([s, -s, -s], [s + 0.03, s, s]),
            ([-s, -s, -s - 0.03], [s, s, -s]),
            ([-s, -s, s], [s, s, s + 0.03]),
            ([-s - 0.03, -s - 0.03, -s - 0.03], [s + 0.03, -s, s + 0.03]),
        ] {
            world.mesh("box", &Shape::block(low, high).placed(1.0, at), wall.clone());
        }
    } else {
        let gap = random.between(0.01, 0.05);
        let count = (2.0 * room.half / 0.2) as usize;
        let mut curtain = Shape::default();
        for k in 0..count {
            let x = -room.half + 0.2 * k as f64;
            let z = at[2] + s + 0.01 * (k % 2) as f64;
            curtain.join(&Shape::block([x, 0.0, z], [x + 0.2 - gap, room.height, z + 0.008]));
        }
        world.mesh("curtain", &curtain, wall);
    }
    room.camera(world, -0.7, 0.7, random);
}

/// Under the sky, with or without a sun.
fn open_air(world: &mut World, random: &mut Random) {
    let room = Room::draw(random);
    let material = draw::matt(world, random);
    match random.below(3) {
        0 => world.sphere([0.0, -1000.0, 0.0], 1000.0, material),
        1 => world.mesh(
            "floor",
            &Shape::quad([[-20.0, 0.0, 20.0], [20.0, 0.0, 20.0], [20.0, 0.0, -20.0], [-20.0, 0.0, -20.0]]),
            material,
        ),
        _ => super::curved::plane(world, [0.0; 3], [0.0, 1.0, 0.0], material, random),
    }
    receivers(world, room, -0.7, 0.7, random);
    let casters = once_in(random, 2);
    things(world, room, 3, casters, random);
    let sunny = once_in(random, 2);
    let away = if sunny && once_in(random, 2) { draw::magnitude(random, 1.0, 1e10) } else { 1.0 };
    if sunny {
        // A lamp above, or one that looks as large and is as far as a sun.
        let place = [random.between(-5.0, 5.0), random.between(5.0, 9.0), random.between(-3.0, 5.0)];
        world.lamp(place.map(|x| away * x), 0.5 * away, [random.between(50.0, 150.0); 3]);
    }
    if once_in(random, 3) {
        // A sky that is a lamp about everything, the sun, too.
        let middle = [0; 3].map(|_| random.between(-9.0, 9.0));
        let radius = away * draw::magnitude(random, 40.0, if sunny { 400.0 } else { 1e9 });
        draw::sky(world, middle, radius, random);
    } else if !sunny || once_in(random, 2) {
        world.desc.background = draw::background(world, random);
    }
    world.camera(
        [random.between(-3.0, 3.0), random.between(1.0, 3.0), 5.0],
        [0.0, 0.5, 0.0],
        random.between(30.0, 60.0),
    );
}

fn crowds(world: &mut World, random: &mut Random) {
    let room = Room::draw(random);
    room.walls(world, &[], random);
    let shines = once_in(random, 3);
    let material = if shines { draw::caster(world, random) } else { draw::matt(world, random) };
    let count = one_of(random, &[20, 200, 1500]);
    draw::crowd(world, count, 0.7 * room.half.min(room.deep), 0.0, material, random);
    let many = one_of(random, &[1, 5, 40]);
    for _ in 0..many {
        let place = room.place(-0.7, 0.7, random);
        draw::lamp(world, place, if many > 5 { 0.08 } else { 0.3 }, random);
    }
    room.camera(world, -0.7, 0.7, random);
}

/// Anything anywhere, one thing in another, lamps too.
fn chaos(world: &mut World, random: &mut Random) {
    let room = Room::draw(random);
    if once_in(random, 2) {
        room.walls(world, &[random.below(6)], random);
    }
    for _ in 0..3 + random.below(8) {
        let place = room.place(-0.9, 0.9, random);
        let material = if once_in(random, 2) { draw::caster(world, random) } else { draw::matt(world, random) };
        let size = draw::magnitude(random, 0.05, 1.2);
        draw::thing(world, place, size, material, random);
    }
    for _ in 0..1 + random.below(3) {
        let place = room.place(-0.9, 0.9, random);
        draw::lamp(world, place, 0.6, random);
    }
    if once_in(random, 3) {
        world.desc.background = draw::background(world, random);
    }
    room.camera(world, -0.9, 0.9, random);
}

/// A few receivers of low albedo on a floor: what is cut off after many bounces is nothing, so that passing a surface
/// that is not there
/// does not show.
fn dim_things(world: &mut World, random: &mut Random) {
    world.mesh("floor", &Shape::block([-3.0, -0.1, -3.0], [3.0, 0.0, 3.0]), matt(random.between(0.2, 0.4)));
    for _ in 0..1 + random.below(2) {
        let kind = one_of(random, &receivers::ALL);
        let at = [random.between(0.9, 1.6), 0.0, random.between(-1.2, 0.8)];
        kind.add(world, random.between(0.5, 0.9), at, matt(random.between(0.2, 0.5)), random);
    }
    world.bounces(16);
}

/// Bulbs and panes of index 1.0, about lamps of all sizes; held against the same without them.
fn shells(world: &mut World, random: &mut Random) {
    dim_things(world, random);
    if once_in(random, 2) {
        world.mesh("wall", &Shape::block([-3.0, 0.0, -3.1], [3.0, 3.0, -3.0]), matt(0.4));
    }
    let at = [random.between(-0.5, 2.0), random.between(1.6, 2.6), random.between(-1.0, 0.5)];
    let lamp = draw::lamp(world, at, 0.4, random);
    world.camera([1.2, random.between(1.5, 3.0), 4.5], [1.2, 0.5, 0.0], random.between(35.0, 50.0));
    if once_in(random, 3) {
        let y = at[1] - 1.2 * lamp;
        world.mesh("pane", &Shape::block([-3.5, y - 0.05, -3.5], [3.5, y, 3.5]), glass(1.0));
    } else {
        bulb(world, at, lamp, |_, _| glass(1.0), random);
    }
}

/// A flat mirror at x = 0, held against the world behind it.
fn unfolded(world: &mut World, random: &mut Random) {
    dim_things(world, random);
    let at = [random.between(0.5, 2.4), random.between(1.0, 2.6), random.between(-1.0, 0.8)];
    let lamp = draw::lamp(world, at, 0.3, random);
    // A black screen keeps the lamp's own light from the things: what comes over the mirror is then most of it.
    let low = (at[1] - lamp - 0.3).max(0.85);
    world.mesh("screen", &Shape::block([at[0] - 0.1, low, -2.0], [3.0, low + 0.03, 2.0]), matt(0.0));
    if once_in(random, 2) {
        super::curved::plane(world, [0.0; 3], [1.0, 0.0, 0.0], mirror(), random);
    } else {
        let corners = [[0.0, -9.0, 9.0], [0.0, -9.0, -9.0], [0.0, 9.0, -9.0], [0.0, 9.0, 9.0]];
        world.mesh(PLANE_MIRROR, &Shape::quad(corners), mirror());
    }
    let eye = [random.between(1.5, 3.0), random.between(1.0, 3.0), 4.5];
    world.camera(eye, [1.2, 0.5, 0.0], random.between(35.0, 50.0));
}

/// A kind: its name, how it is made, what it is held against, whether light is hard to find.
type Kind = (&'static str, fn(&mut World, &mut Random), Relation, bool);

/// All kinds, drawn alike.
#[rustfmt::skip]
pub const KINDS: [Kind; 20] = [
    ("plain room", plain_room, Relation::Path, false),
    ("casters", casters, Relation::Path, false),
    ("bulbs", bulbs, Relation::Path, false),
    ("panes", panes, Relation::Path, false),
    ("mirrors", mirrors, Relation::Path, false),
    ("door ajar", door_ajar, Relation::Path, true),
    ("pinhole", pinhole, Relation::Path, true),
    ("dark room", dark_room, Relation::Dark, false),
    ("small window", small_window, Relation::Path, true),
    ("hidden lamp", hidden_lamp, Relation::Path, true),
    ("open air", open_air, Relation::Path, false),
    ("crowds", crowds, Relation::Path, false),
    ("chaos", chaos, Relation::Path, false),
    ("shells", shells, Relation::Shells, false),
    ("unfolded", unfolded, Relation::Unfolded, false),
    ("flipped", casters, Relation::Flipped, false),
    ("ring", super::rings::ring, Relation::Path, false),
    ("shut-in lamp", shut_in_lamp, Relation::ShutIn, false),
    ("furnace", super::furnace::furnace, Relation::Furnace, false),
    ("standing solids", super::standing::standing, Relation::Dark, false),
];

/// Whether a pattern lies in the scene's space, whatever is done to what it is on.
fn lies_in_the_world(albedo: &Albedo) -> bool {
    albedo.pattern().is_some_and(|pattern| {
        matches!(pattern.mapping(), Some(SolidMapping::World { .. }))
            || pattern.parts().into_iter().any(lies_in_the_world)
    })
}

/// Takes off what has no mirror image: textures of spheres, which lie by longitude, and patterns that lie in the world.
fn without_what_has_no_image(world: &mut World) {
    let textured: Vec<bool> = world
        .desc
        .objects
        .iter()
        .map(|object| {
            let sphere = matches!(object.value, Object::Sphere(_));
            let plain = |material: &Material| material.varying().into_iter().all(Albedo::is_color);
            let in_world = |material: &Material| material.varying().into_iter().any(lies_in_the_world);
            let material = draw::material_of(world, &object.value);
            sphere && !material.is_none_or(plain) || material.is_some_and(in_world)
        })
        .collect();
    for (object, textured) in world.desc.objects.iter_mut().zip(textured) {
        if textured {
            draw::set_material(&mut object.value, matt(0.5));
        }
    }
}

/// The kind that a seed draws.
pub fn kind(seed: u64) -> &'static str {
    KINDS[Random::new(seed).below(KINDS.len())].0
}

/// The scene of a seed. Sizes that are no whole number of tiles occur in `golden/`; here all are `size` x `size`.
pub fn case(seed: u64, size: u32) -> Case {
    let mut random = Random::new(seed);
    let random = &mut random;
    let (kind, make, relation, hard) = KINDS[random.below(KINDS.len())];
    let mut world = World::new(size);
    let bounces = one_of(random, &[0, 1, 2, 3, 5, 5, 5, 8]);
    // Where no light could come in one bounce, a picture of one says nothing.
    world.bounces(if hard { bounces.max(3) } else { bounces });
    make(&mut world, random);
    if matches!(relation, Relation::Path | Relation::Flipped) && once_in(random, 3) {
        super::shining::other_lamps(&mut world, random);
    }
    if relation != Relation::Unfolded {
        draw::film(&mut world, random);
        super::view::view(&mut world, random);
    }
    if relation == Relation::Dark {
        super::view::from_the_eye(&mut world);
    }
    if once_in(random, 4) && !matches!(relation, Relation::Unfolded | Relation::Shells) {
        draw::name_materials(&mut world);
    }
    if matches!(relation, Relation::Flipped) {
        // A camera that is turned about its axis would have to be turned the other way.
        world.desc.camera.up = [0.0, 1.0, 0.0].into();
        // The eyes of a mirror image have changed places.
        if let Some(stereo) = &mut world.desc.camera.stereo {
            stereo.layout = StereoLayout::SideBySide;
        }
    }
    if matches!(relation, Relation::Flipped | Relation::Unfolded) {
        without_what_has_no_image(&mut world);
    }
    // Names change no picture: they are drawn aside, so that all else stays as it is without them.
    super::textures::name_textures(&mut world, &mut random.clone());
    // Up along the view is refused; drawn so with probability zero. A drop is the last kind of step to be told apart.
    if let Some(Object::Mesh(mesh)) = world.desc.objects.last_mut().map(|object| &mut object.value)
        && mesh.transform.len() == 1
    {
        mesh.transform.push(Transform::DropTo { y: 0.0 }.into());
    }
    if relation == Relation::Path && !once_in(random, 3) {
        draw::hide(&mut world, random);
    }
    draw::light_groups(&mut world, random);
    Case { seed, kind, world, relation, hard }
}
