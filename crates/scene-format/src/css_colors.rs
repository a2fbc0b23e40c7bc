//! Colours as CSS writes them, for hints: names, and functions such as `hsl(200, 50%, 50%)`.

/// The names of CSS Color Module Level 4 (section 6.1) with their values, in order.
const NAMES: &str = "\
    aliceblue f0f8ff antiquewhite faebd7 aqua 00ffff aquamarine 7fffd4 azure f0ffff beige f5f5dc bisque ffe4c4 \
    black 000000 blanchedalmond ffebcd blue 0000ff blueviolet 8a2be2 brown a52a2a burlywood deb887 \
    cadetblue 5f9ea0 chartreuse 7fff00 chocolate d2691e coral ff7f50 cornflowerblue 6495ed cornsilk fff8dc \
    crimson dc143c cyan 00ffff darkblue 00008b darkcyan 008b8b darkgoldenrod b8860b darkgray a9a9a9 \
    darkgreen 006400 darkgrey a9a9a9 darkkhaki bdb76b darkmagenta 8b008b darkolivegreen 556b2f darkorange ff8c00 \
    darkorchid 9932cc darkred 8b0000 darksalmon e9967a darkseagreen 8fbc8f darkslateblue 483d8b \
    darkslategray 2f4f4f darkslategrey 2f4f4f darkturquoise 00ced1 darkviolet 9400d3 deeppink ff1493 \
    deepskyblue 00bfff dimgray 696969 dimgrey 696969 dodgerblue 1e90ff firebrick b22222 floralwhite fffaf0 \
    forestgreen 228b22 fuchsia ff00ff gainsboro dcdcdc ghostwhite f8f8ff gold ffd700 goldenrod daa520 \
    gray 808080 green 008000 greenyellow adff2f grey 808080 honeydew f0fff0 hotpink ff69b4 indianred cd5c5c \
    indigo 4b0082 ivory fffff0 khaki f0e68c lavender e6e6fa lavenderblush fff0f5 lawngreen 7cfc00 \
    lemonchiffon fffacd lightblue add8e6 lightcoral f08080 lightcyan e0ffff lightgoldenrodyellow fafad2 \
    lightgray d3d3d3 lightgreen 90ee90 lightgrey d3d3d3 lightpink ffb6c1 lightsalmon ffa07a lightseagreen 20b2aa \
    lightskyblue 87cefa lightslategray 778899 lightslategrey 778899 lightsteelblue b0c4de lightyellow ffffe0 \
    lime 00ff00 limegreen 32cd32 linen faf0e6 magenta ff00ff maroon 800000 mediumaquamarine 66cdaa \
    mediumblue 0000cd mediumorchid ba55d3 mediumpurple 9370db mediumseagreen 3cb371 mediumslateblue 7b68ee \
    mediumspringgreen 00fa9a mediumturquoise 48d1cc mediumvioletred c71585 midnightblue 191970 mintcream f5fffa \
    mistyrose ffe4e1 moccasin ffe4b5 navajowhite ffdead navy 000080 oldlace fdf5e6 olive 808000 olivedrab 6b8e23 \
    orange ffa500 orangered ff4500 orchid da70d6 palegoldenrod eee8aa palegreen 98fb98 paleturquoise afeeee \
    palevioletred db7093 papayawhip ffefd5 peachpuff ffdab9 peru cd853f pink ffc0cb plum dda0dd \
    powderblue b0e0e6 purple 800080 rebeccapurple 663399 red ff0000 rosybrown bc8f8f royalblue 4169e1 \
    saddlebrown 8b4513 salmon fa8072 sandybrown f4a460 seagreen 2e8b57 seashell fff5ee sienna a0522d \
    silver c0c0c0 skyblue 87ceeb slateblue 6a5acd slategray 708090 slategrey 708090 snow fffafa \
    springgreen 00ff7f steelblue 4682b4 tan d2b48c teal 008080 thistle d8bfd8 tomato ff6347 turquoise 40e0d0 \
    violet ee82ee wheat f5deb3 white ffffff whitesmoke f5f5f5 yellow ffff00 yellowgreen 9acd32";

/// The hexadecimal value of a colour's name.
pub(crate) fn named_color(name: &str) -> Option<String> {
    let mut words = NAMES.split(' ');
    std::iter::from_fn(|| Some((words.next()?, words.next()?)))
        .find(|(known, _)| name.eq_ignore_ascii_case(known))
        .map(|(_, digits)| format!("#{digits}"))
        .or_else(|| grey_of_x11(name))
}

/// `gray30`, as X11 and what was made for it name so many percent of white.
fn grey_of_x11(name: &str) -> Option<String> {
    let (word, percent) = name.split_at_checked(4).filter(|(_, percent)| percent.len() <= 3)?;
    let is_grey = word.eq_ignore_ascii_case("gray") || word.eq_ignore_ascii_case("grey");
    let digits = !percent.is_empty() && percent.bytes().all(|byte| byte.is_ascii_digit());
    let percent: u32 = percent.parse().ok().filter(|percent| is_grey && digits && *percent <= 100)?;
    let byte = (f64::from(percent) * 2.55).round() as u8;
    Some(format!("#{byte:02x}{byte:02x}{byte:02x}"))
}

/// The hexadecimal value of `rgb(255, 0, 0)`, `hsl(200, 50%, 50%)`, `hsv(..)` and the like that a text begins with, and
/// how long that is. Hues are in degrees; shares are percentages, or from 0 to 1; an alpha is left out where it is 1.
pub(crate) fn function(text: &str) -> Option<(String, usize)> {
    let open = text.bytes().take(5).position(|byte| byte == b'(')?;
    let name = text[..open].to_ascii_lowercase();
    let close = open + text[open..].bytes().take(80).position(|byte| byte == b')')?;
    let split = |sign: char| matches!(sign, ',' | ' ' | '/');
    let parts: Vec<&str> = text[open + 1..close].split(split).filter(|part| !part.is_empty()).collect();
    let (parts, alpha) = parts.split_at_checked(3)?;
    if !matches!(alpha, [] | ["1" | "1.0" | "100%"]) {
        return None;
    }
    let share = |text: &str| -> Option<f64> {
        let value = match text.strip_suffix('%') {
            Some(number) => number.parse::<f64>().ok()? / 100.0,
            None => text.parse().ok()?,
        };
        (0.0..=1.0).contains(&value).then_some(value)
    };
    let channels = match &*name {
        "rgb" | "rgba" => {
            let byte = |text: &&str| match text.strip_suffix('%') {
                Some(_) => share(text),
                None => text.parse::<u8>().ok().map(|byte| f64::from(byte) / 255.0),
            };
            parts.iter().map(byte).collect::<Option<Vec<f64>>>()?
        }
        "hsl" | "hsla" | "hsv" | "hsva" | "hsb" => {
            let hue: f64 = parts[0].trim_end_matches("deg").parse().ok().filter(|hue: &f64| hue.abs() < 1e4)?;
            // Some write 50 for 50 %.
            let percent = |text: &str| share(text).or_else(|| share(&format!("{text}%")));
            let (saturation, light) = (percent(parts[1])?, percent(parts[2])?);
            let (chroma, low) = if name.starts_with("hsl") {
                let chroma = saturation * (1.0 - (2.0 * light - 1.0).abs());
                (chroma, light - chroma / 2.0)
            } else {
                (light * saturation, light * (1.0 - saturation))
            };
            // Each channel is full up to 60 degrees from its own hue, and falls to nothing at 120.
            let channel = |of: f64| {
                let away = 3.0 - (((hue - of) / 60.0).rem_euclid(6.0) - 3.0).abs();
                low + chroma * (2.0 - away).clamp(0.0, 1.0)
            };
            vec![channel(0.0), channel(120.0), channel(240.0)]
        }
        _ => return None,
    };
    let digits: String = channels.iter().map(|channel| format!("{:02x}", (channel * 255.0).round() as u8)).collect();
    Some((format!("#{digits}"), close + 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of CSS Color Module Level 4.
    #[test]
    fn names_and_functions_are_those_of_css() {
        for (name, hex) in [("aliceblue", "#f0f8ff"), ("SkyBlue", "#87ceeb"), ("yellowgreen", "#9acd32")] {
            assert_eq!(named_color(name).as_deref(), Some(hex));
        }
        assert_eq!(named_color("f0f8ff"), None);
        for (name, hex) in [("gray0", "#000000"), ("gray30", "#4d4d4d"), ("Grey50", "#7f7f7f"), ("gray100", "#ffffff")]
        {
            assert_eq!(named_color(name).as_deref(), Some(hex));
        }
        assert_eq!(["gray101", "gray+1", "gray-1", "greyish", "gra1"].map(named_color), [const { None }; 5]);
        assert_eq!(NAMES.split(' ').count(), 2 * 148);
        for (written, hex) in [
            ("hsl(120, 100%, 50%)", "#00ff00"),
            ("hsl(197.4deg 71.4% 72.5%)", "#87ceeb"),
            ("hsl(270, 50, 40)", "#663399"),
            ("hsl(-90, 0.5, 0.4)", "#663399"),
            ("hsv(39, 100%, 100%)", "#ffa600"),
            ("hsb(0, 0%, 50%)", "#808080"),
            ("rgb(102, 51, 153)", "#663399"),
            ("rgba(40%, 20%, 60%, 1)", "#663399"),
        ] {
            let found = function(written);
            assert_eq!(found, Some((hex.to_owned(), written.len())), "{written}");
        }
        for written in ["hsl(1, 2)", "hsl(", "rgba(1, 2, 3, 0.5)", "hsl(a, b, c)", "vec3(1, 2, 3)", "rgb(300, 0, 0)"] {
            assert_eq!(function(written), None, "{written}");
        }
    }
}
