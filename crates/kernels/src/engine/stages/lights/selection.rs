//! Which light to ask: down the tree of lights.

use super::Receiver;
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::scene::LightTable;

/// A light, and how likely it was to be chosen.
pub struct Choice<F: Lanes> {
    /// Which one.
    pub light: F::U,
    /// Its probability.
    pub probability: F,
    /// It is the picture of all directions, which has no number.
    pub environment: F::M,
}

/// How likely the picture of all directions is chosen where there are other lights, too.
pub const ENVIRONMENT: f32 = 0.5;

/// Which light to ask: down the tree of lights, at each step to one of two children by what they may send, power over
/// squared distance times a bound on the cosine at the receiver and one on how far they face it (Conty Estevez and
/// Kulla: Importance Sampling of Many Lights with Adaptive Tree Splitting, 2018). Unlike there distance and cosine are
/// rather those of the middle than bounds ([`Node::importance`]), and the way that lights face grows with a cosine
/// instead of that of an angle ([`Node::facing`]).
#[inline(always)]
pub fn choose<F: Lanes>(lights: &LightTable, at: Receiver<F>, u: F, v: F) -> Choice<F> {
    let one = F::splat(1.0);
    let mut environment = F::M::from_bits(0);
    let (mut u, mut chance_of_all) = (u, one);
    if lights.environment.is_some() {
        if lights.asked == 0 {
            return Choice { light: F::U::splat(0), probability: one, environment: F::first(F::N) };
        }
        environment = u.lt(F::splat(ENVIRONMENT));
        chance_of_all = F::select(environment, F::splat(ENVIRONMENT), F::splat(1.0 - ENVIRONMENT));
        u = ((u - F::splat(ENVIRONMENT)) * F::splat(1.0 / (1.0 - ENVIRONMENT))).max(F::splat(0.0));
    }
    let (mut content, mut probability) = (root::<F>(lights), one);
    for level in 0..lights.depth {
        let step = if level == 0 { Step::below_root(lights, at) } else { Step::new(lights, content, at) };
        // Each step takes a bit of a number of 24.
        if level == SECOND_NUMBER {
            u = v;
        }
        let second = step.first.le(u);
        let chance = F::select(second, F::splat(1.0) - step.first, step.first);
        let rest = F::select(second, u - step.first, u) / chance;
        u = F::select(step.inner, rest.min(F::splat(ALMOST_ONE)), u);
        probability = F::select(step.inner, probability * chance, probability);
        content = step.child(second, content);
    }
    if lights.environment.is_some() {
        probability = F::select(environment, chance_of_all, probability * chance_of_all);
    }
    Choice { light: content & F::U::splat(!LightTable::LEAF), probability, environment }
}

/// From this step on the second random number is used.
const SECOND_NUMBER: u32 = 11;
const ALMOST_ONE: f32 = 1.0 - 1.0 / 16_777_216.0;

/// The probability that [`choose`] takes this light.
#[inline(always)]
pub fn probability<F: Lanes>(lights: &LightTable, light: F::U, at: Receiver<F>) -> F {
    let (mut content, mut probability) = (root::<F>(lights), F::splat(1.0));
    let mut trail = F::U::gather(&lights.trail, light);
    for level in 0..lights.depth {
        let step = if level == 0 { Step::below_root(lights, at) } else { Step::new(lights, content, at) };
        let second = (trail & F::U::splat(1)).eq(F::U::splat(1));
        trail = trail.shr::<1>();
        let chance = F::select(second, F::splat(1.0) - step.first, step.first);
        probability = F::select(step.inner, probability * chance, probability);
        content = step.child(second, content);
    }
    probability
}

/// What the root holds; see [`LightTable::tree`].
#[inline(always)]
fn root<F: Lanes>(lights: &LightTable) -> F::U {
    F::splat(lights.tree[LightTable::CONTENT]).to_bits()
}

/// One step down the tree.
struct Step<F: Lanes> {
    /// The node has children.
    inner: F::M,
    /// What they hold.
    contents: [F::U; 2],
    /// Probability of the first one.
    first: F,
}

impl<F: Lanes> Step<F> {
    /// From a node that holds this.
    #[inline(always)]
    fn new(lights: &LightTable, content: F::U, at: Receiver<F>) -> Self {
        let inner = content.lt(F::U::splat(LightTable::LEAF));
        let children = F::U::select(inner, content, F::U::splat(0));
        let nodes = [Node::load(lights, children), Node::load(lights, children + F::U::splat(1))];
        Step::between(lights, inner, nodes, at)
    }
    /// From the root, which has children, and the same ones for all lanes.
    #[inline(always)]
    fn below_root(lights: &LightTable, at: Receiver<F>) -> Self {
        let nodes = lights.tree.as_chunks().0;
        Step::between(lights, F::first(F::N), [Node::splat(&nodes[1]), Node::splat(&nodes[2])], at)
    }
    #[inline(always)]
    fn between(lights: &LightTable, inner: F::M, [a, b]: [Node<F>; 2], at: Receiver<F>) -> Self {
        let contents = [a.content, b.content];
        let spheres = F::U::splat(lights.spheres);
        let (a, b) = if lights.has_others() {
            (a.importance(spheres, at) * a.facing(at), b.importance(spheres, at) * b.facing(at))
        } else {
            (a.importance(spheres, at), b.importance(spheres, at))
        };
        let (sum, zero) = (a + b, F::splat(0.0));
        let any = zero.lt(sum);
        let first = F::select(any, a / F::select(any, sum, F::splat(1.0)), F::splat(0.5));
        let bounded = first.max(F::splat(lights.least_chance)).min(F::splat(1.0 - lights.least_chance));
        Step { inner, contents, first: F::select(zero.lt(a) & zero.lt(b), bounded, first) }
    }
    #[inline(always)]
    fn child(&self, second: F::M, content: F::U) -> F::U {
        let child = F::U::select(second, self.contents[1], self.contents[0]);
        F::U::select(self.inner, child, content)
    }
}

/// A node of the tree of lights.
struct Node<F: Lanes> {
    /// Middle and radius of a sphere around the lights below.
    center: V3<F>,
    radius: F,
    power: F,
    /// See [`LightTable::tree`].
    content: F::U,
    /// See [`LightTable::tree`].
    few: F,
    /// Which way the lights face, see [`LightTable::tree`]. Not loaded where all lights are spheres.
    slack: F,
    axis: V3<F>,
    around: F,
}

/// Lights in a sphere of radius r whose middle is d away send as if they were sqrt(d^2 + r^2 / 10) away. A bound on the
/// distance would be d - r; this, [`LEAST_HEIGHT`] and [`LightTable::FEW`] were found by trial (docs/noise.md).
const SPREAD: f32 = 0.1;
/// Lights in a sphere whose highest point is h above the horizon are taken to be this part of h above it at least.
const LEAST_HEIGHT: f32 = 0.25;

impl<F: Lanes> Node<F> {
    #[inline(always)]
    fn load(lights: &LightTable, node: F::U) -> Self {
        let at = node * F::U::splat(LightTable::STRIDE);
        let [x, y, z, radius] = F::gather4(&lights.tree, at);
        let (mut slack, mut axis, mut around) = (F::splat(0.0), V3::zero(), F::splat(1.0));
        let (power, content, few);
        if lights.has_others() {
            [power, content, few, slack] = F::gather4(&lights.tree, at + F::U::splat(4));
            let [x, y, z, all] = F::gather4(&lights.tree, at + F::U::splat(8));
            (axis, around) = (V3(x, y, z), all);
        } else {
            [power, content, few] = F::gather3(&lights.tree, at + F::U::splat(4));
        }
        Node { center: V3(x, y, z), radius, power, content: content.to_bits(), few, slack, axis, around }
    }

    /// The same for all lanes, from its numbers.
    #[inline(always)]
    fn splat(numbers: &[f32; LightTable::STRIDE as usize]) -> Self {
        let c = F::splat;
        let &[x, y, z, radius, power, content, few, slack, nx, ny, nz, around] = numbers;
        Node {
            center: V3(c(x), c(y), c(z)),
            radius: c(radius),
            power: c(power),
            content: c(content).to_bits(),
            few: c(few),
            slack: c(slack),
            axis: V3(c(nx), c(ny), c(nz)),
            around: c(around),
        }
    }

    /// How much of their faces lights with one side turn to the receiver: of a single one its cosine there, seen from
    /// its middle; above zero wherever the receiver is in front of one of them. One for others.
    #[inline(always)]
    fn facing(&self, receiver: Receiver<F>) -> F {
        let from = receiver.p.sub(self.center);
        let length2 = from.dot(from);
        let cos =
            (from.dot(self.axis) + self.slack) / F::select(F::splat(0.0).lt(length2), length2, F::splat(1.0)).sqrt();
        (cos + self.around).max(F::splat(0.0)).min(F::splat(1.0))
    }

    /// What the lights below may send to the receiver, but for a factor: power over squared distance, times a cosine
    /// there: of few lights a bound, of many one rather of their middle, never zero while some of the sphere is above
    /// the horizon. Within a sphere that shines inwards, a sky, as much comes as at its surface, from wherever it is
    /// seen: as if the receiver were as far from its middle.
    #[inline(always)]
    fn importance(&self, spheres: F::U, receiver: Receiver<F>) -> F {
        let (r, zero) = (self.radius, F::splat(0.0));
        let to = self.center.sub(receiver.p);
        let (r2, is_sphere) = (r * r, (self.content - F::U::splat(LightTable::LEAF)).lt(spheres));
        let distance2 = to.dot(to).max(F::select(is_sphere, r2, zero));
        let inverse = F::splat(1.0) / (distance2 + r2 * F::splat(SPREAD));
        let middle = to.dot(receiver.n);
        let height = (middle + r * self.few).max((middle + r).max(zero) * F::splat(LEAST_HEIGHT));
        self.power * inverse * (height * inverse.sqrt()).min(F::splat(1.0))
    }
}
