//! The functions of expressions. Angles are in degrees.

use super::Value;
use super::blackbody::blackbody;

/// Names that stand for a number.
pub(super) const CONSTANTS: [(&str, f64); 1] = [("pi", std::f64::consts::PI)];

/// A function: its name, how it is called, what that gives in words, and what it does; `None` where it does not
/// take such values.
pub(super) struct Function {
    pub name: &'static str,
    pub call: &'static str,
    pub does: &'static str,
    pub apply: fn(&[Value]) -> Option<Value>,
}

macro_rules! functions {
    ($($name:literal $call:literal $does:literal $apply:expr;)+) => {
        pub(super) const FUNCTIONS: &[Function] =
            &[$(Function { name: $name, call: $call, does: $does, apply: $apply },)+];
    };
}

functions! {
    "abs" "abs(x)" "without its sign" |a| each(a, f64::abs);
    "sign" "sign(x)" "-1, 0 or 1" |a| each(a, |x| if x > 0.0 { 1.0 } else if x < 0.0 { -1.0 } else { 0.0 });
    "floor" "floor(x)" "the next whole number below" |a| each(a, f64::floor);
    "ceil" "ceil(x)" "the next whole number above" |a| each(a, f64::ceil);
    "round" "round(x)" "the nearest whole number" |a| each(a, f64::round);
    "sqrt" "sqrt(x)" "the square root" |a| each(a, f64::sqrt);
    "exp" "exp(x)" "e to the power of x" |a| each(a, libm::exp);
    "log" "log(x)" "the natural logarithm" |a| each(a, libm::log);
    "sin" "sin(degrees)" "the sine of an angle in degrees" |a| each(a, |x| turned(x).0);
    "cos" "cos(degrees)" "the cosine of an angle in degrees" |a| each(a, |x| turned(x).1);
    "tan" "tan(degrees)" "the tangent of an angle in degrees" |a| each(a, |x| turned(x).0 / turned(x).1);
    "asin" "asin(x)" "the angle in degrees whose sine is x" |a| each(a, |x| libm::asin(x).to_degrees());
    "acos" "acos(x)" "the angle in degrees whose cosine is x" |a| each(a, |x| libm::acos(x).to_degrees());
    "atan" "atan(x)" "the angle in degrees whose tangent is x" |a| each(a, |x| libm::atan(x).to_degrees());
    "atan2" "atan2(y, x)" "the angle in degrees of the direction (x, y)"
        |a| pairwise(a, |y, x| libm::atan2(y, x).to_degrees());
    "min" "min(a, b, ..)" "the least" |a| fold(a, f64::min);
    "max" "max(a, b, ..)" "the most" |a| fold(a, f64::max);
    "clamp" "clamp(x, low, high)" "x, but no less than low and no more than high" |a| match a {
        [x, low, high] => x.zip(low, f64::max)?.zip(high, f64::min),
        _ => None,
    };
    "mix" "mix(a, b, t)" "from a where t is 0 to b where t is 1" |a| match a {
        [from, to, t] => {
            let way = to.zip(from, |b, a| b - a)?;
            from.zip(&way.zip(t, |d, t| d * t)?, |a, d| a + d)
        }
        _ => None,
    };
    "step" "step(edge, x)" "0 below the edge, else 1" |a| pairwise(a, |edge, x| if x < edge { 0.0 } else { 1.0 });
    "smoothstep" "smoothstep(low, high, x)" "from 0 at low to 1 at high, smoothly" |a| match a {
        [Value::Number(low), Value::Number(high), x] => x.map(|x| {
            let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
            t * t * (3.0 - 2.0 * t)
        }),
        _ => None,
    };
    "length" "length(v)" "how long a vector is" |a| match a {
        [v @ (Value::Pair(_) | Value::Triple(_))] => Some(Value::Number(length(v.numbers()))),
        _ => None,
    };
    "normalize" "normalize(v)" "the vector of length 1 in that direction" |a| match a {
        [v @ (Value::Pair(_) | Value::Triple(_))] => {
            let length = length(v.numbers());
            v.map(|x| x / length)
        }
        _ => None,
    };
    "dot" "dot(a, b)" "the dot product" |a| match a {
        [a @ (Value::Pair(_) | Value::Triple(_)), b] if a.numbers().len() == b.numbers().len() => {
            Some(Value::Number(a.numbers().iter().zip(b.numbers()).map(|(a, b)| a * b).sum()))
        }
        _ => None,
    };
    "cross" "cross(a, b)" "the cross product" |a| match a {
        [Value::Triple([ax, ay, az]), Value::Triple([bx, by, bz])] => {
            Some(Value::Triple([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]))
        }
        _ => None,
    };
    "hsv" "hsv(hue, saturation, value)" "a colour by hue in degrees, saturation and value of sRGB" |a| match a {
        [Value::Number(h), Value::Number(s), Value::Number(v)] => Some(Value::Triple(hsv(*h, *s, *v))),
        _ => None,
    };
    "blackbody" "blackbody(kelvin), from 500 to 40000" "the colour of what glows at that temperature, of luminance 1"
        |a| match a {
        [Value::Number(kelvin)] => blackbody(*kelvin).map(Value::Triple),
        _ => None,
    };
    "random" "random(n, ..)" "a number from 0 to 1, the same for the same one to four numbers" |a| match a {
        [] => None,
        _ if a.len() > 4 => None,
        _ => {
            let numbers: Option<Vec<f64>> =
                a.iter().map(|x| if let Value::Number(x) = x { Some(*x) } else { None }).collect();
            numbers.map(|numbers| Value::Number(random(&numbers)))
        }
    };
    "len" "len(list)" "how many values a list has" |a| match a {
        [Value::List(list)] => Some(Value::Number(list.items().len() as f64)),
        [v @ (Value::Pair(_) | Value::Triple(_))] => Some(Value::Number(v.numbers().len() as f64)),
        _ => None,
    };
    "keyframes" "keyframes(t, t0, value0, t1, value1, ..), t0 < t1 < .., values of one type"
        "linear between rising times, the first or last value outside" |a| match a {
        [Value::Number(t), keys @ ..] => keyframes(*t, keys),
        _ => None,
    };
    "if" "if(condition, a, b)" "a where the condition is true, else b" |a| match a {
        [Value::Bool(condition), a, b] => Some(if *condition { a } else { b }.clone()),
        _ => None,
    };
}

/// The value at t, linear between keys, the first or last one outside; `None` unless times rise.
fn keyframes(t: f64, keys: &[Value]) -> Option<Value> {
    let (keys, rest) = keys.as_chunks::<2>();
    let time = |key: &[Value; 2]| if let Value::Number(time) = key[0] { Some(time) } else { None };
    let times: Vec<f64> = keys.iter().map(time).collect::<Option<_>>()?;
    let rising = times.windows(2).all(|pair| pair[0] < pair[1]);
    let count = keys.first()?[1].numbers().len();
    let alike = keys.iter().all(|key| key[1].numbers().len() == count) && count > 0;
    if !rest.is_empty() || !rising || !alike {
        return None;
    }
    let after = times.partition_point(|&time| time <= t);
    match (after.checked_sub(1).map(|k| &keys[k][1]), keys.get(after).map(|key| &key[1])) {
        (Some(from), Some(to)) => {
            let share = (t - times[after - 1]) / (times[after] - times[after - 1]);
            from.zip(to, |a, b| a + (b - a) * share)
        }
        (from, to) => from.or(to).cloned(),
    }
}

/// Why there is no value by these keys; `None`: nothing special.
pub(super) fn why_no_keyframes(arguments: &[Value]) -> Option<String> {
    let (t, keys) = arguments.split_first()?;
    if !matches!(t, Value::Number(_)) {
        return Some(format!("its first value is the time, a number, and not {}", t.noun()));
    }
    let (keys, rest) = keys.as_chunks::<2>();
    if !rest.is_empty() {
        return Some("each time has its value, and the last one has none".to_owned());
    }
    if keys.is_empty() {
        return Some("it has no keys".to_owned());
    }
    let mut before: Option<f64> = None;
    for (k, [time, value]) in keys.iter().enumerate() {
        let Value::Number(time) = time else {
            return Some(format!("time {k} is {}", time.noun()));
        };
        if let Some(before) = before.filter(|before| before >= time) {
            return Some(format!("its times must rise, and {time} follows {before}"));
        }
        before = Some(*time);
        if value.numbers().is_empty() {
            return Some(format!("value {k} is {}, which has nothing between", value.noun()));
        }
    }
    let first = &keys[0][1];
    let other = keys.iter().find(|[_, value]| value.numbers().len() != first.numbers().len());
    other.map(|[_, value]| format!("its values are {} and {}", first.noun(), value.noun()))
}

fn each(arguments: &[Value], f: impl Fn(f64) -> f64) -> Option<Value> {
    match arguments {
        [x] => x.map(f),
        _ => None,
    }
}

fn pairwise(arguments: &[Value], f: impl Fn(f64, f64) -> f64) -> Option<Value> {
    match arguments {
        [a, b] => a.zip(b, f),
        _ => None,
    }
}

fn fold(arguments: &[Value], f: impl Fn(f64, f64) -> f64) -> Option<Value> {
    let (first, rest) = arguments.split_first()?;
    rest.iter().try_fold(first.map(|x| x)?, |so_far, x| so_far.zip(x, &f))
}

fn length(numbers: &[f64]) -> f64 {
    numbers.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Sine and cosine of an angle in degrees; exact at whole right angles.
fn turned(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        rest => (libm::sin(rest.to_radians()), libm::cos(rest.to_radians())),
    }
}

/// A colour by hue in degrees, saturation and value (Smith: Color Gamut Transform Pairs, 1978), sRGB, made linear.
fn hsv(hue: f64, saturation: f64, value: f64) -> [f64; 3] {
    let channel = |offset: f64| {
        let k = (offset + hue / 60.0).rem_euclid(6.0);
        value - value * saturation * k.min(4.0 - k).clamp(0.0, 1.0)
    };
    [5.0, 3.0, 1.0].map(|offset| crate::read::linear_from_srgb(channel(offset)))
}

/// A number from 0 to 1, the same for the same numbers: a hash of their bits (SplitMix64, Steele et al. 2014).
fn random(numbers: &[f64]) -> f64 {
    let mut state = 0x9e37_79b9_7f4a_7c15u64;
    for number in numbers {
        // Zero has two signs.
        state = (state ^ (number + 0.0).to_bits()).wrapping_add(0x9e37_79b9_7f4a_7c15);
        state = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        state = (state ^ (state >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        state ^= state >> 31;
    }
    (state >> 11) as f64 / (1u64 << 53) as f64
}
