//! How what lies between two circles is cut, so that its normals are those of a round surface.
//!
//! A piece between two circles of unequal radii r and s is a trapezoid. Two triangles shade it askew: where the share w
//! of the way along their common edge is done, the place is w s/((1-w) r + w s) of the piece round, the normal w of it.
//! With the outward parts o and p of the normals the normal is off by |p r - o s|/(sqrt(r) + sqrt(s))^2 pieces at most,
//! for a cone o tanh(L/4), L = |ln(s/r)|. Four triangles about a vertex on its middle line, where it is sqrt(r s) wide,
//! are off by o tanh(L/8)/2 at most, and as much to either side. Rings between whose radii are in even ratio make L
//! less.

/// Two triangles may be askew by this share of a piece: all of them are to the same side, by which glass loses light.
const PLAIN: f64 = 1.0 / 128.0;

/// Others by this share at most.
const MOST: f64 = 1.0 / 16.0;

/// Next to a sharp tip the normals of the last triangles are off by half a piece at most: within e^-2 of its radius.
const TIP: f64 = 0.135_335_283_236_613;

/// How a band is cut.
#[derive(Clone, Debug, PartialEq)]
pub struct Cut {
    /// How far along it its rings lie, from 0 to 1.
    pub rings: Vec<f64>,
    /// Whether its trapezoids have a vertex in the middle.
    pub middles: bool,
}

impl Cut {
    /// Two triangles a piece.
    fn plain() -> Self {
        Cut { rings: vec![0.0, 1.0], middles: false }
    }

    /// Of a band between circles with these radii, whose normals have these parts outwards.
    pub fn new(radii: [f64; 2], outs: [f64; 2]) -> Self {
        let [r, s] = radii;
        let roots = r.sqrt() + s.sqrt();
        if (outs[1] * r - outs[0] * s).abs() <= PLAIN * roots * roots {
            return Cut::plain();
        }
        let most = outs[0].abs().max(outs[1].abs());
        let share = 2.0 * MOST / most;
        // Where the normals have little outwards, one band is good whatever its radii.
        let bands =
            if share < 1.0 { (libm::log(s / r).abs() / (8.0 * libm::atanh(share))).ceil().max(1.0) } else { 1.0 };
        Cut { rings: rings(bands as u32, radii), middles: true }
    }

    /// Of a band that begins or ends in a sharp tip: the piece there is a triangle with a normal of its own.
    pub fn to_tip(at_end: bool, outs: [f64; 2]) -> Self {
        let radii = if at_end { [1.0, TIP] } else { [TIP, 1.0] };
        let mut cut = Cut::new(radii, outs);
        if !cut.middles {
            return Cut::plain();
        }
        for ring in &mut cut.rings {
            *ring = if at_end { *ring * (1.0 - TIP) } else { TIP + *ring * (1.0 - TIP) };
        }
        // The ends to the bit.
        if at_end {
            cut.rings.push(1.0);
        } else {
            cut.rings.pop();
            cut.rings.push(1.0);
            cut.rings.insert(0, 0.0);
        }
        cut
    }

    /// How many triangles a piece has, each band of which lies between two rings, or a ring and a tip.
    pub fn triangles(&self, tips: [bool; 2]) -> u64 {
        let bands = self.rings.len() as u64 - 1;
        let ends = u64::from(tips[0]) + u64::from(tips[1]);
        let each = if self.middles { 4 } else { 2 };
        ends + each * bands.saturating_sub(ends)
    }
}

/// Rings of as many bands, whose radii are in even ratio.
pub fn rings(bands: u32, [r, s]: [f64; 2]) -> Vec<f64> {
    let ratio = s / r;
    let even =
        |share: f64| if (ratio - 1.0).abs() < 1e-3 { share } else { (libm::pow(ratio, share) - 1.0) / (ratio - 1.0) };
    // The ends to the bit.
    let of = |k: u32| match k {
        0 => 0.0,
        k if k == bands => 1.0,
        k => even(f64::from(k) / f64::from(bands)),
    };
    (0..=bands).map(of).collect()
}

/// How far from the first circle the vertex in the middle of a trapezoid lies.
pub fn middle([r, s]: [f64; 2]) -> f64 {
    r.sqrt() / (r.sqrt() + s.sqrt())
}
