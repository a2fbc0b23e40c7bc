//! Textures made of others, as a list of steps.

use super::materials::{MaterialBuilder, constants};
use super::textures::{Lies, Lying, lying};
use scene_format::desc::{self, RampInterpolation, SolidMapping, VertexColorSpace};
use scene_format::diagnostic::Span;
use scene_format::{Diagnostic, codes};
use std::path::Path;
use tracer_kernels::scene::{Albedo, Between, Made, Op, PLACES, Program, Space, VertexSpace};

/// What a step works on.
#[derive(Clone, Copy)]
enum Operand<'w> {
    /// A colour or a texture, no name of one, where a number is wanted or where a colour is.
    Of(&'w desc::Albedo, bool),
    /// How far a pattern is from its first part to its second.
    Between(&'w desc::Albedo),
}

/// What the texture of these words is made of; nothing where it is one step.
fn operands(words: &desc::Albedo, number: bool) -> Vec<Operand<'_>> {
    let parts = words.pattern().map_or_else(Vec::new, |pattern| pattern.parts());
    let parts: Vec<&desc::Albedo> = parts.into_iter().map(desc::Albedo::resolved).collect();
    match (words, &parts[..]) {
        (desc::Albedo::ColorRamp(_), [input]) => vec![Operand::Of(input, true)],
        (desc::Albedo::Mix(_), [a, b, weight]) => {
            vec![Operand::Of(a, number), Operand::Of(b, number), Operand::Of(weight, true)]
        }
        (desc::Albedo::Multiply(_), [a, b]) => vec![Operand::Of(a, number), Operand::Of(b, number)],
        (_, [a, b]) if constants(words).is_none() => {
            vec![Operand::Of(a, number), Operand::Of(b, number), Operand::Between(words)]
        }
        _ => Vec::new(),
    }
}

/// How a texture lies that is no colour and not made of others alone.
fn lies(words: &desc::Albedo) -> Option<Lying> {
    let mapping = match words {
        desc::Albedo::Texture(texture) => texture.mapping.clone().into(),
        other => other.pattern()?.mapping()?,
    };
    Some(lying(&mapping))
}

/// Places that an operand needs, its own among them.
fn need(of: Operand<'_>) -> usize {
    let (words, within) = match of {
        Operand::Of(words, number) => (words, operands(words, number)),
        Operand::Between(words) => (words, Vec::new()),
    };
    if within.is_empty() {
        return if matches!(lies(words), Some(Lying::Thrice(..))) { 3 } else { 1 };
    }
    let mut needs: Vec<usize> = within.into_iter().map(need).collect();
    needs.sort_by(|a, b| b.cmp(a));
    needs.iter().enumerate().map(|(taken, need)| taken + need).max().unwrap_or(1)
}

impl MaterialBuilder<'_> {
    /// A texture made of others.
    pub(super) fn program(&mut self, words: &desc::Albedo, number: bool, base: Option<&Path>) -> Albedo {
        let whole = Operand::Of(words, number);
        if need(whole) > PLACES {
            let message = "a texture is made of too many others";
            self.faults.push(Diagnostic::error(codes::TOO_MUCH, Span::NONE, message).expected("at most 1024"));
            return Albedo::Color([1.0; 3]);
        }
        let mut program = Program::default();
        self.step(&mut program, whole, 0, base);
        let next = self.programs.len() as u32;
        // Numbers are written with all digits that tell them apart.
        let index = *self.index_of_program.entry(format!("{program:?}")).or_insert(next);
        if index == next {
            self.programs.push(program);
        }
        Albedo::Program(index)
    }

    /// Adds the steps that write an operand to a place; those behind it are free.
    fn step(&mut self, program: &mut Program, of: Operand<'_>, to: usize, base: Option<&Path>) {
        let (words, number) = match of {
            Operand::Of(words, number) => (words, number),
            Operand::Between(words) => return self.lying_pattern(program, words, [[0.0; 3], [1.0; 3]], to),
        };
        let within = operands(words, number);
        // Those that need most come first, when most places are free.
        let mut order: Vec<usize> = (0..within.len()).collect();
        order.sort_by_key(|&k| std::cmp::Reverse(need(within[k])));
        let mut place = [0; 3];
        for (taken, &k) in order.iter().enumerate() {
            place[k] = (to + taken) as u8;
            self.step(program, within[k], to + taken, base);
        }
        let [first, second, third] = place;
        let made = match words {
            desc::Albedo::Color(color) => Made::Color(color.value),
            desc::Albedo::Texture(texture) => return self.lying_picture(program, texture, number, to, base),
            desc::Albedo::VertexColor(colors) => Made::VertexColor(match colors.color_space {
                VertexColorSpace::Auto => VertexSpace::AsFile,
                VertexColorSpace::Srgb => VertexSpace::Srgb,
                VertexColorSpace::Linear => VertexSpace::Linear,
            }),
            desc::Albedo::ColorRamp(ramp) => ramp_of(program, ramp, first),
            desc::Albedo::Multiply(_) => Made::Multiply([first, second]),
            _ => match constants(words) {
                Some(colors) if within.is_empty() => return self.lying_pattern(program, words, colors, to),
                _ => Made::Mix([first, second, third]),
            },
        };
        push(program, made, to);
    }

    /// Adds a pattern between two colours.
    fn lying_pattern(&mut self, program: &mut Program, words: &desc::Albedo, colors: [desc::Color; 2], to: usize) {
        let mut one = |lies: &Lies| Made::Pattern(self.pattern(words, lies, colors).unwrap_or_default());
        match lies(words) {
            Some(Lying::Once(lies)) => push(program, one(&lies), to),
            Some(Lying::Thrice(sides, sharpness)) => {
                let made = [one(&sides[0]), one(&sides[1]), one(&sides[2])];
                thrice(program, made, sharpness, to);
            }
            None => {}
        }
    }

    /// Adds a picture.
    fn lying_picture(
        &mut self,
        program: &mut Program,
        words: &desc::Texture,
        number: bool,
        to: usize,
        base: Option<&Path>,
    ) {
        if let Some(uv) = words.mapping.by_uv() {
            let texture = self.picture(words, number, uv.rows(), base);
            return push(program, Made::Texture { texture, space: Space::Uv, map: [[0.0; 4]; 3] }, to);
        }
        let mut one = |lies: &Lies| {
            let [u, v] = lies.across;
            let texture = self.picture(words, number, [[u, 0.0, 0.0], [0.0, v, 0.0]], base);
            Made::Texture { texture, space: lies.space, map: lies.map }
        };
        match lying(&SolidMapping::from(words.mapping.clone())) {
            Lying::Once(lies) => push(program, one(&lies), to),
            Lying::Thrice(sides, sharpness) => thrice(program, sides.map(|lies| one(&lies)), sharpness, to),
        }
    }
}

fn push(program: &mut Program, made: Made, to: usize) {
    program.ops.push(Op { to: to as u8, made });
}

/// Adds what is seen from three sides.
fn thrice(program: &mut Program, sides: [Made; 3], sharpness: f64, to: usize) {
    for (k, made) in sides.into_iter().enumerate() {
        push(program, made, to + k);
    }
    push(program, Made::Triplanar { colors: [0, 1, 2].map(|k| (to + k) as u8), sharpness }, to);
}

/// A ramp by what is at a place.
fn ramp_of(program: &mut Program, ramp: &desc::ColorRamp, input: u8) -> Made {
    let first = program.stops.len() as u32;
    program.stops.extend(ramp.stops.0.iter().map(|stop| (stop.at.value, stop.color.value)));
    let between = match ramp.interpolation {
        RampInterpolation::Linear => Between::Linear,
        RampInterpolation::Smooth => Between::Smooth,
        RampInterpolation::Constant => Between::Constant,
    };
    Made::Ramp { input, first, count: ramp.stops.0.len() as u32, between }
}
