//! Lights and what shines by chance.

use super::Random;
use super::generated::{length, name, share, text, vector};
use super::textures::albedo;
use scene_format::desc::*;

fn amount(random: &mut Random, color: Color) -> Amount {
    match random.below(6) {
        0 => Amount::Radiance(color),
        1 => Amount::Intensity(color),
        2 => Amount::Power(color),
        3 => Amount::Luminance(color[0]),
        4 => Amount::LuminousIntensity(color[1]),
        _ => Amount::LuminousPower(color[2]),
    }
}

fn tint(random: &mut Random) -> Color {
    if random.below(2) == 0 { [1.0; 3] } else { share(random) }
}

pub(super) fn light_group(random: &mut Random) -> LightGroup {
    LightGroup::from((random.below(3) == 0).then(|| format!("of {}", text(random))))
}

pub(super) fn emissive(random: &mut Random) -> Emissive {
    let color = share(random).map(|channel| channel * 1e3);
    // Only some shapes have an intensity.
    let amount = match amount(random, color) {
        Amount::Intensity(color) => Amount::Radiance(color),
        Amount::LuminousIntensity(number) => Amount::Luminance(number),
        other => other,
    };
    // A texture is of points.
    let of_points = matches!(amount, Amount::Radiance(_) | Amount::Luminance(_));
    let color = if of_points && random.below(3) == 0 { albedo(random) } else { tint(random).into() };
    Emissive { amount: amount.into(), color, two_sided: random.below(2) == 0, group: light_group(random) }
}

pub(super) fn sphere_light(random: &mut Random) -> Light {
    let color = share(random).map(|channel| channel * 100.0);
    Light::SphereLight(SphereLight {
        center: vector(random).into(),
        radius: length(random).into(),
        amount: amount(random, color).into(),
        color: tint(random),
        camera_visible: random.below(4) != 0,
        name: name(random),
        group: light_group(random),
    })
}
