//! Sixteen rays in one space, made ready together: [`RaySpace`] in lanes, with the same bits, and the beam around them.

use super::super::Rays;
use super::super::layout::Node;
use super::super::ray_space::{PAD, RANGE, RaySpace, SMALLEST_COMPONENT};
use super::isa::{Isa, Isa16, Lanes};
use super::packet::gather;
use std::ops::Range;

/// Rays whose directions (divided by their largest component) spread further than this are no beam.
const WIDEST_SPREAD: f32 = 0.25;
/// Nor are those whose origins spread further than this part of the scene.
const WIDEST_START: f32 = 0.125;

/// The rays of a packet in one space. Indices of arrays are axes, of `shear` and `shear_origin` roles, as in
/// [`RaySpace`].
#[derive(Clone)]
pub struct PacketSpace {
    pub origin: [Lanes; 3],
    pub direction: [Lanes; 3],
    /// Minus the distances by which the origins were moved.
    pub tmin: Lanes,
    pub rd: [Lanes; 3],
    pub near_offset: [Lanes; 3],
    pub far_offset: [Lanes; 3],
    pub shear_origin: [Lanes; 3],
    pub shear: [Lanes; 3],
    /// Lanes whose direction is largest along x, y, z.
    pub largest: [u32; 3],
    /// Lanes whose direction is negative along x, y, z.
    pub negative: [u32; 3],
    /// The roles' axes, where all lanes have the same.
    pub axes: Option<[u32; 3]>,
    /// The beam, where all lanes go into the same octant.
    pub beam: Option<Beam>,
}

/// Bounds on all rays of a packet. Let p − o run over a plane's distances from the origins: the packet's rays reach
/// the plane no sooner than the least of the products with the reciprocals, no later than the greatest.
///
/// The origins are widened by 2^-18 of the largest coordinate, twice what the rays' own tests are, and the interval
/// by 2^-18 of itself, so that the beam is in every box that a ray's test says the ray is in (see [`RaySpace`]).
#[derive(Clone, Copy)]
pub struct Beam {
    pub octant: u32,
    least_rd: [f32; 3],
    greatest_rd: [f32; 3],
    /// The origins to count near planes and far planes from.
    enter: [f32; 3],
    leave: [f32; 3],
    least_tmin: f32,
    greatest_tmin: f32,
}

impl PacketSpace {
    pub const NOWHERE: Self = {
        let zero = [Lanes([0.0; 16]); 3];
        Self {
            origin: zero,
            direction: zero,
            tmin: Lanes([0.0; 16]),
            rd: zero,
            near_offset: zero,
            far_offset: zero,
            shear_origin: zero,
            shear: zero,
            largest: [0; 3],
            negative: [0; 3],
            axes: None,
            beam: None,
        }
    };

    /// Loads up to 16 rays of a batch, which are those of `run` where there is one, and makes them ready as they are in
    /// the world. Returns the lanes that are rays.
    #[inline(always)]
    pub fn load<I: Isa16>(&mut self, isa: I, source: &Rays, rays: &[u32], run: &Option<Range<usize>>) -> u32 {
        let (origin, direction) = ([source.ox, source.oy, source.oz], [source.dx, source.dy, source.dz]);
        for axis in 0..3 {
            gather(&mut self.origin[axis].0, origin[axis], rays, run);
            gather(&mut self.direction[axis].0, direction[axis], rays, run);
        }
        self.prepare(isa, (1u32 << rays.len()) - 1)
    }

    /// Makes the rays of `lanes` ready, whose `origin`, `direction` and `tmin` are set. Returns the lanes that are
    /// rays; the others are made copies of one of them.
    #[inline(always)]
    pub fn prepare<I: Isa16>(&mut self, isa: I, lanes: u32) -> u32 {
        let valid = lanes & self.rays(isa);
        if valid == 0 {
            return 0;
        }
        if valid != 0xFFFF {
            let first = valid.trailing_zeros() as usize & 15;
            for axis in 0..3 {
                fill(isa, &mut self.origin[axis], !valid, first);
                fill(isa, &mut self.direction[axis], !valid, first);
            }
            fill(isa, &mut self.tmin, !valid, first);
        }
        let [ox, oy, oz] = [isa.load16(&self.origin[0]), isa.load16(&self.origin[1]), isa.load16(&self.origin[2])];
        let [dx, dy, dz] =
            [isa.load16(&self.direction[0]), isa.load16(&self.direction[1]), isa.load16(&self.direction[2])];
        let [ax, ay, az] = [isa.abs16(dx), isa.abs16(dy), isa.abs16(dz)];
        let x_over_y = isa.lt16(ay, ax);
        let on_x = x_over_y & isa.lt16(az, ax);
        let on_y = !x_over_y & isa.lt16(az, ay) & 0xFFFF;
        let on_z = !(on_x | on_y) & 0xFFFF;
        self.largest = [on_x, on_y, on_z];
        self.axes = match self.largest {
            [0xFFFF, 0, 0] => Some([1, 2, 0]),
            [0, 0xFFFF, 0] => Some([2, 0, 1]),
            [0, 0, 0xFFFF] => Some([0, 1, 2]),
            _ => None,
        };
        let far = isa.max16(isa.max16(isa.abs16(ox), isa.abs16(oy)), isa.abs16(oz));
        let pad = isa.mul16(isa.splat16(PAD), far);
        let least = isa.mul16(isa.max16(isa.max16(ax, ay), az), isa.splat16(SMALLEST_COMPONENT));
        self.slabs(isa, 0, ox, dx, ax, least, pad);
        self.slabs(isa, 1, oy, dy, ay, least, pad);
        self.slabs(isa, 2, oz, dz, az, least, pad);

        let pick = |x, y, z| isa.select16(on_x, x, isa.select16(on_y, y, z));
        let inverse = isa.div16(isa.splat16(1.0), pick(dx, dy, dz));
        isa.store16(pick(oy, oz, ox), &mut self.shear_origin[0]);
        isa.store16(pick(oz, ox, oy), &mut self.shear_origin[1]);
        isa.store16(pick(ox, oy, oz), &mut self.shear_origin[2]);
        isa.store16(isa.mul16(pick(dy, dz, dx), inverse), &mut self.shear[0]);
        isa.store16(isa.mul16(pick(dz, dx, dy), inverse), &mut self.shear[1]);
        isa.store16(inverse, &mut self.shear[2]);

        self.negative = [isa.signs16(dx), isa.signs16(dy), isa.signs16(dz)];
        let uniform = |signs: u32| signs == 0 || signs == 0xFFFF;
        let one_octant = uniform(self.negative[0]) && uniform(self.negative[1]) && uniform(self.negative[2]);
        self.beam = if one_octant { Some(self.beam(isa, isa.greatest16(far))) } else { None };
        valid
    }

    /// The lanes that [`RaySpace::new`] would not refuse.
    #[inline(always)]
    fn rays<I: Isa16>(&self, isa: I) -> u32 {
        let range = isa.splat16(RANGE);
        let mut valid = 0xFFFF;
        let mut largest = isa.splat16(0.0);
        for axis in 0..3 {
            let d = isa.abs16(isa.load16(&self.direction[axis]));
            valid &= isa.le16(isa.abs16(isa.load16(&self.origin[axis])), range) & isa.le16(d, range);
            largest = isa.max16(largest, d);
        }
        valid & isa.le16(isa.splat16(1.0 / RANGE), largest)
    }

    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "one axis of six quantities")]
    fn slabs<I: Isa16>(&mut self, isa: I, axis: usize, o: I::F16, d: I::F16, a: I::F16, least: I::F16, pad: I::F16) {
        let rd = isa.div16(isa.splat16(1.0), isa.copysign16(isa.max16(a, least), d));
        let wide = isa.mul16(pad, isa.abs16(rd));
        isa.store16(rd, &mut self.rd[axis]);
        isa.store16(isa.fmadd16(o, rd, wide), &mut self.near_offset[axis]);
        isa.store16(isa.fmsub16(o, rd, wide), &mut self.far_offset[axis]);
    }

    #[inline(always)]
    fn beam<I: Isa16>(&self, isa: I, far: f32) -> Beam {
        let margin = far * (2.0 * PAD);
        let tmin = isa.load16(&self.tmin);
        let mut beam = Beam {
            octant: 0,
            least_rd: [0.0; 3],
            greatest_rd: [0.0; 3],
            enter: [0.0; 3],
            leave: [0.0; 3],
            least_tmin: isa.least16(tmin),
            greatest_tmin: isa.greatest16(tmin),
        };
        for axis in 0..3 {
            let (rd, o) = (isa.load16(&self.rd[axis]), isa.load16(&self.origin[axis]));
            let (low, high) = (isa.least16(o) - margin, isa.greatest16(o) + margin);
            beam.least_rd[axis] = isa.least16(rd);
            beam.greatest_rd[axis] = isa.greatest16(rd);
            let negative = self.negative[axis] & 1;
            beam.octant |= negative << axis;
            (beam.enter[axis], beam.leave[axis]) = if negative == 0 { (high, low) } else { (low, high) };
        }
        beam
    }

    /// Whether the rays go so much the same way that a packet is worth while.
    #[inline(always)]
    pub fn is_coherent<I: Isa16>(&self, isa: I, scene_size: f32) -> bool {
        let (Some(beam), Some(_)) = (&self.beam, self.axes) else { return false };
        let spread = |lanes: &Lanes| isa.greatest16(isa.load16(lanes)) - isa.least16(isa.load16(lanes));
        let start = |axis: usize| (beam.enter[axis] - beam.leave[axis]).abs();
        spread(&self.shear[0]) <= WIDEST_SPREAD
            && spread(&self.shear[1]) <= WIDEST_SPREAD
            && (0..3).all(|axis| start(axis) <= WIDEST_START * scene_size)
    }

    /// One ray of the packet.
    #[inline(always)]
    pub fn lane(&self, lane: usize) -> RaySpace {
        let bit = |masks: &[u32; 3], axis: usize| masks[axis] >> lane & 1;
        // Looked up, not branched on: which axis it is cannot be predicted.
        let z = bit(&self.largest, 1) | bit(&self.largest, 2) << 1;
        let axes = [[1, 2, 0], [2, 0, 1], [0, 1, 2], [0, 1, 2]][(z & 3) as usize];
        let at = |values: &[Lanes; 3]| [values[0].0[lane], values[1].0[lane], values[2].0[lane]];
        RaySpace {
            rd: at(&self.rd),
            near_offset: at(&self.near_offset),
            far_offset: at(&self.far_offset),
            octant: bit(&self.negative, 0) | bit(&self.negative, 1) << 1 | bit(&self.negative, 2) << 2,
            axes,
            shear_origin: at(&self.shear_origin),
            shear: at(&self.shear),
        }
    }

    /// The octant of the first lane.
    pub fn octant(&self) -> u32 {
        (self.negative[0] & 1) | (self.negative[1] & 1) << 1 | (self.negative[2] & 1) << 2
    }

    /// The lanes that are in a box (lower and upper planes) no later than `limit`.
    #[inline(always)]
    pub fn in_box<I: Isa16>(&self, isa: I, lower: [f32; 3], upper: [f32; 3], limit: I::F16) -> u32 {
        let (near, far) = self.interval(isa, lower, upper);
        let tmin = isa.load16(&self.tmin);
        let near = isa.max16(near, tmin);
        isa.le16(near, far) & isa.le16(isa.sub16(near, tmin), limit)
    }

    /// When the rays enter and leave a box.
    #[inline(always)]
    pub fn interval<I: Isa16>(&self, isa: I, lower: [f32; 3], upper: [f32; 3]) -> (I::F16, I::F16) {
        let x = self.slab(isa, 0, lower[0], upper[0]);
        let y = self.slab(isa, 1, lower[1], upper[1]);
        let z = self.slab(isa, 2, lower[2], upper[2]);
        (isa.max16(isa.max16(x.0, y.0), z.0), isa.min16(isa.min16(x.1, y.1), z.1))
    }

    #[inline(always)]
    fn slab<I: Isa16>(&self, isa: I, axis: usize, lower: f32, upper: f32) -> (I::F16, I::F16) {
        let rd = isa.load16(&self.rd[axis]);
        let (enter, leave) = (isa.load16(&self.near_offset[axis]), isa.load16(&self.far_offset[axis]));
        if self.beam.is_some() {
            let negative = self.negative[axis] != 0;
            let (first, last) = if negative { (upper, lower) } else { (lower, upper) };
            return (isa.fmsub16(isa.splat16(first), rd, enter), isa.fmsub16(isa.splat16(last), rd, leave));
        }
        let (lower, upper) = (isa.splat16(lower), isa.splat16(upper));
        (
            isa.min16(isa.fmsub16(lower, rd, enter), isa.fmsub16(upper, rd, enter)),
            isa.max16(isa.fmsub16(lower, rd, leave), isa.fmsub16(upper, rd, leave)),
        )
    }
}

impl Beam {
    /// Lower bounds on the (world) distances at which the packet's rays enter the eight boxes; NaN where none does.
    #[inline(always)]
    pub fn enter<I: Isa>(&self, isa: I, node: &Node) -> I::F8 {
        let (mut near, mut far) = (isa.splat8(self.least_tmin), isa.splat8(f32::INFINITY));
        for axis in 0..3 {
            let negative = (self.octant >> axis & 1) as usize;
            // SAFETY: rows of a node are aligned to 32 bytes.
            let (first, last) = unsafe {
                (
                    isa.load8(node.planes[2 * axis + negative].as_ptr()),
                    isa.load8(node.planes[2 * axis + 1 - negative].as_ptr()),
                )
            };
            let first = isa.sub8(first, isa.splat8(self.enter[axis]));
            let last = isa.sub8(last, isa.splat8(self.leave[axis]));
            let (least, greatest) = (isa.splat8(self.least_rd[axis]), isa.splat8(self.greatest_rd[axis]));
            near = isa.max8(near, isa.min8(isa.mul8(first, least), isa.mul8(first, greatest)));
            far = isa.min8(far, isa.max8(isa.mul8(last, least), isa.mul8(last, greatest)));
        }
        // Widened by 2^-18 outwards, whatever the signs: min and max of the products with 1 ± 2^-18.
        let (less, more) = (isa.splat8(1.0 - 2.0 * PAD), isa.splat8(1.0 + 2.0 * PAD));
        let near = isa.min8(isa.mul8(near, less), isa.mul8(near, more));
        let far = isa.max8(isa.mul8(far, less), isa.mul8(far, more));
        isa.where_le8(near, far, isa.sub8(near, isa.splat8(self.greatest_tmin)))
    }
}

#[inline(always)]
fn fill<I: Isa16>(isa: I, lanes: &mut Lanes, missing: u32, from: usize) {
    let copy = isa.splat16(lanes.0[from]);
    isa.store16(isa.select16(missing & 0xFFFF, copy, isa.load16(lanes)), lanes);
}
