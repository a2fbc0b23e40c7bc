//! How much light is given, in radiometric or photometric units.

use super::Color;

/// Lumens per watt of luminance Y: the most that light can have (CIE, at 555 nm), as the colours of a scene are taken.
const LUMENS_PER_WATT: f64 = 683.0;

/// How much light is given: one quantity, per channel or, as people see it, for all of them. With cd, lm and cd/m^2 the
/// scene's unit is the metre.
#[derive(Clone, Debug, PartialEq)]
pub enum Amount {
    /// Radiance in W/(sr m^2).
    Radiance(Color),
    /// Radiant intensity in W/sr.
    Intensity(Color),
    /// Power in W.
    Power(Color),
    /// Luminance in cd/m^2.
    Luminance(f64),
    /// Luminous intensity in cd.
    LuminousIntensity(f64),
    /// Luminous flux in lm.
    LuminousPower(f64),
}

/// How much light is given, per channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Radiometric {
    /// Radiance in W/(sr m^2).
    Radiance(Color),
    /// Radiant intensity in W/sr.
    Intensity(Color),
    /// Power in W.
    Power(Color),
}

impl Amount {
    /// Where it is said of a whole lamp: the word, and that which says the like of each point.
    pub fn of_whole(&self) -> Option<(&'static str, &'static str)> {
        match self {
            Amount::Radiance(_) | Amount::Luminance(_) => None,
            Amount::Intensity(_) => Some(("intensity", "radiance")),
            Amount::Power(_) => Some(("power", "radiance")),
            Amount::LuminousIntensity(_) => Some(("luminous_intensity", "luminance")),
            Amount::LuminousPower(_) => Some(("luminous_power", "luminance")),
        }
    }

    /// The amount times `color` / Y(`color`), Y = 0.2126 R + 0.7152 G + 0.0722 B; photometric ones are 683 lm/W Y.
    pub fn radiometric(&self, color: Color) -> Radiometric {
        // Beside the largest channel, so that none is too small to be divided by.
        let largest = color.into_iter().fold(0.0, f64::max);
        let [r, g, b] = if largest > 0.0 { color.map(|c| c / largest) } else { [0.0; 3] };
        let luminance = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        let tint = match largest {
            0.0 => [0.0; 3],
            // Greys are as they are written, to the last bit.
            _ if r == g && g == b => [1.0; 3],
            _ => [r, g, b].map(|c| c / luminance),
        };
        let times = |amount: Color| [amount[0] * tint[0], amount[1] * tint[1], amount[2] * tint[2]];
        let seen = |amount: f64| times([amount / LUMENS_PER_WATT; 3]);
        match *self {
            Amount::Radiance(radiance) => Radiometric::Radiance(times(radiance)),
            Amount::Intensity(intensity) => Radiometric::Intensity(times(intensity)),
            Amount::Power(power) => Radiometric::Power(times(power)),
            Amount::Luminance(luminance) => Radiometric::Radiance(seen(luminance)),
            Amount::LuminousIntensity(intensity) => Radiometric::Intensity(seen(intensity)),
            Amount::LuminousPower(power) => Radiometric::Power(seen(power)),
        }
    }

    /// So many times as much.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Amount {
        let times = |amount: Color| amount.map(|c| c * factor);
        match *self {
            Amount::Radiance(radiance) => Amount::Radiance(times(radiance)),
            Amount::Intensity(intensity) => Amount::Intensity(times(intensity)),
            Amount::Power(power) => Amount::Power(times(power)),
            Amount::Luminance(luminance) => Amount::Luminance(luminance * factor),
            Amount::LuminousIntensity(intensity) => Amount::LuminousIntensity(intensity * factor),
            Amount::LuminousPower(power) => Amount::LuminousPower(power * factor),
        }
    }

    /// Whether it is an intensity, which only some shapes have.
    pub fn is_intensity(&self) -> bool {
        matches!(self, Amount::Intensity(_) | Amount::LuminousIntensity(_))
    }
}

/// The six fields one of which says an amount, as the words of a light have them.
macro_rules! amount_of {
    ($words:expr) => {{
        use $crate::desc::Amount;
        let of_color = |color: Option<Spanned<Color>>, kind: fn(Color) -> Amount| {
            color.map(|color| Spanned { value: kind(color.value), span: color.span })
        };
        let of_number = |number: Option<Spanned<f64>>, kind: fn(f64) -> Amount| {
            number.map(|number| Spanned { value: kind(number.value), span: number.span })
        };
        of_color($words.radiance, Amount::Radiance)
            .or(of_color($words.intensity, Amount::Intensity))
            .or(of_color($words.power, Amount::Power))
            .or(of_number($words.luminance, Amount::Luminance))
            .or(of_number($words.luminous_intensity, Amount::LuminousIntensity))
            .or(of_number($words.luminous_power, Amount::LuminousPower))
    }};
}

/// Puts an amount into the words that say it.
macro_rules! put_amount {
    ($amount:expr, $words:expr) => {{
        use $crate::desc::Amount;
        match $amount {
            Amount::Radiance(color) => $words.radiance = Some(color.into()),
            Amount::Intensity(color) => $words.intensity = Some(color.into()),
            Amount::Power(color) => $words.power = Some(color.into()),
            Amount::Luminance(number) => $words.luminance = Some(number.into()),
            Amount::LuminousIntensity(number) => $words.luminous_intensity = Some(number.into()),
            Amount::LuminousPower(number) => $words.luminous_power = Some(number.into()),
        }
    }};
}

pub(super) use {amount_of, put_amount};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn amounts_in_watts() {
        let near = |got: Radiometric, expected: Radiometric| {
            let parts = |of: Radiometric| match of {
                Radiometric::Radiance(c) => (0, c),
                Radiometric::Intensity(c) => (1, c),
                Radiometric::Power(c) => (2, c),
            };
            let (got, expected) = (parts(got), parts(expected));
            assert_eq!(got.0, expected.0);
            (0..3).for_each(|c| assert!((got.1[c] - expected.1[c]).abs() < 1e-12 * expected.1[c].abs().max(1.0)));
        };
        // White of 683 lm is 1 W in each channel; a colour counts by what it is beside its luminance.
        near(Amount::LuminousPower(683.0).radiometric([1.0; 3]), Radiometric::Power([1.0; 3]));
        near(Amount::Luminance(1366.0).radiometric([0.3; 3]), Radiometric::Radiance([2.0; 3]));
        let green = Amount::LuminousIntensity(683.0).radiometric([0.0, 4.0, 0.0]);
        near(green, Radiometric::Intensity([0.0, 1.0 / 0.7152, 0.0]));
        near(Amount::Radiance([2.0, 3.0, 5.0]).radiometric([1.0; 3]), Radiometric::Radiance([2.0, 3.0, 5.0]));
        near(Amount::Power([1.0; 3]).radiometric([0.0; 3]), Radiometric::Power([0.0; 3]));
        let faint = Amount::Power([1.0; 3]).radiometric([5e-324, 0.0, 0.0]);
        near(faint, Radiometric::Power([1.0 / 0.2126, 0.0, 0.0]));
        // What people see of it is what was asked for, whatever the colour.
        let Radiometric::Radiance([r, g, b]) = Amount::Luminance(100.0).radiometric([0.9, 0.2, 0.7]) else { panic!() };
        assert!((683.0 * (0.2126 * r + 0.7152 * g + 0.0722 * b) - 100.0).abs() < 1e-9);
    }
}
