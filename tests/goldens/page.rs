//! The page that shows how a picture differs from its golden one: a single file that opens from disk, pictures and all.

use super::Picture;
use libtest_mimic::Failed;
use std::fmt::Write as _;
use tracer::compare::flip::flip;
use tracer::compare::magma;

/// What the page shows.
pub struct Page<'a> {
    /// `family/case`.
    pub name: &'a str,
    /// In a sentence, how the pictures differ.
    pub what: &'a str,
    /// The text of the scene.
    pub scene: &'a str,
    /// What was made.
    pub actual: &'a Picture,
    /// What is expected, if there is a golden picture.
    pub expected: Option<&'a Picture>,
}

/// The command that takes what was made as the golden picture.
pub fn command(name: &str) -> String {
    format!("cargo xtask golden accept {name} --reason \"why it changed\"")
}

const STYLE: &str = "body{font:14px sans-serif;background:#222;color:#ddd;margin:16px}a{color:#8cf}\
    img{width:384px;image-rendering:pixelated;background:#000;display:block}figure{display:inline-block;margin:0 16px 16px 0;vertical-align:top}\
    #wipe{position:relative;width:384px}#wipe img+img{position:absolute;left:0;top:0;clip-path:inset(0 0 0 50%)}\
    input{width:384px}pre{background:#111;padding:8px;overflow:auto}ol{font-family:monospace;white-space:pre;background:#111;padding:8px 8px 8px 56px}";

impl Page<'_> {
    /// The page as HTML.
    pub fn html(&self) -> Result<String, Failed> {
        let Page { name, what, scene, actual, expected } = self;
        let mut page = format!(
            "<!doctype html>\n<meta charset=utf-8>\n<title>{}</title>\n<style>{STYLE}</style>\n<h1>{}</h1>\n<p>{}</p>\n",
            escaped(name),
            escaped(name),
            escaped(what)
        );
        let made = data(actual)?;
        figure(&mut page, &made, "actual");
        if let Some(expected) = expected {
            let golden = data(expected)?;
            figure(&mut page, &golden, "expected");
            if (expected.width, expected.height) == (actual.width, actual.height) {
                let _ = writeln!(
                    page,
                    "<figure><div id=wipe><img src=\"{golden}\"><img id=top src=\"{made}\"></div>\
                     <input type=range value=50 oninput=\"document.getElementById('top').style.clipPath='inset(0 0 0 '+this.value+'%)'\">\
                     <figcaption>wipe: expected | actual</figcaption></figure>"
                );
                figure(&mut page, &data(&difference(actual, expected).picture)?, "difference, times 8");
                let (map, mean, largest) = flip_map(expected, actual);
                let caption =
                    format!("FLIP: what the eye sees; mean {mean:.4}, largest {largest:.4} (black 0, pale yellow 1)");
                figure(&mut page, &data(&map)?, &caption);
            }
        }
        let accept = escaped(&command(name));
        let _ = write!(page, "<p>Accept it, when it is right, with</p>\n<pre>{accept}</pre>\n<p>The scene:</p>\n<ol>");
        for line in scene.lines() {
            let _ = write!(page, "<li>{}", escaped(line));
        }
        page.push_str("</ol>\n");
        Ok(page)
    }
}

fn figure(page: &mut String, source: &str, caption: &str) {
    let _ = writeln!(page, "<figure><img src=\"{source}\"><figcaption>{}</figcaption></figure>", escaped(caption));
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Where pictures differ.
pub struct Difference {
    /// The difference of each channel, times eight.
    pub picture: Picture,
    /// Pixels that differ.
    pub count: usize,
    /// Largest difference of a channel, of 255.
    pub largest: u8,
}

/// Of pictures of one size.
pub fn difference(actual: &Picture, expected: &Picture) -> Difference {
    let rgb: Vec<u8> = actual.rgb.iter().zip(&expected.rgb).map(|(a, e)| a.abs_diff(*e)).collect();
    Difference {
        count: rgb.chunks(3).filter(|pixel| pixel.iter().any(|&d| d > 0)).count(),
        largest: rgb.iter().copied().max().unwrap_or(0),
        picture: Picture {
            width: actual.width,
            height: actual.height,
            rgb: rgb.iter().map(|d| d.saturating_mul(8)).collect(),
        },
    }
}

/// FLIP of each pixel in false colours, its mean and its largest value.
fn flip_map(expected: &Picture, actual: &Picture) -> (Picture, f32, f32) {
    let display = |p: &Picture| -> Vec<f32> { p.rgb.iter().map(|&x| f32::from(x) / 255.0).collect() };
    let values = flip(&display(expected), &display(actual), actual.width as usize);
    let rgb = values.iter().flat_map(|&x| magma(x)).map(|c| (c * 255.0 + 0.5) as u8).collect();
    let mean = values.iter().sum::<f32>() / values.len() as f32;
    (Picture { width: actual.width, height: actual.height, rgb }, mean, values.iter().copied().fold(0.0, f32::max))
}

/// The picture as the address of an image: a PNG in base 64.
fn data(picture: &Picture) -> Result<String, Failed> {
    Ok(format!("data:image/png;base64,{}", base64(&picture.png()?)))
}

/// RFC 4648, section 4.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let word = chunk.iter().enumerate().fold(0u32, |word, (k, &byte)| word | u32::from(byte) << (16 - 8 * k));
        for digit in 0..4 {
            let known = digit <= chunk.len();
            text.push(if known { DIGITS[(word >> (18 - 6 * digit) & 63) as usize] as char } else { '=' });
        }
    }
    text
}

/// The page holds all that it needs, and says what a person does next.
pub fn check_page() -> Result<(), Failed> {
    let picture = |shift: u8| Picture {
        width: 12,
        height: 8,
        rgb: (0..12 * 8 * 3u32).map(|k| (k % 200) as u8 + shift * u8::from(k % 7 == 0)).collect(),
    };
    let (actual, expected) = (picture(40), picture(0));
    let scene = "Scene(\n    objects: [Sphere(center: (0, 0, 0), radius: 1)], // 1 < 2 & 3\n)\n";
    let page = Page { name: "family/case", what: "pixels differ", scene, actual: &actual, expected: Some(&expected) };
    let html = page.html()?;
    for (part, count) in [
        ("<img ", 6),
        ("src=\"data:image/png;base64,iVBORw0KGgo", 6),
        ("type=range", 1),
        ("difference, times 8", 1),
        ("FLIP: what the eye sees", 1),
        ("cargo xtask golden accept family/case --reason &quot;why it changed&quot;", 1),
        ("<li>    objects: [Sphere(center: (0, 0, 0), radius: 1)], // 1 &lt; 2 &amp; 3", 1),
        ("src=", 6),
    ] {
        if html.matches(part).count() != count {
            return Err(format!("{part:?} occurs {} times, not {count}, in\n{html}", html.matches(part).count()).into());
        }
    }
    // A new case has nothing to be compared with.
    let alone = Page { expected: None, ..page }.html()?;
    if alone.matches("<img ").count() != 1 {
        return Err(format!("one picture was expected in\n{alone}").into());
    }
    // The test vectors of RFC 4648, section 10.
    for (bytes, text) in
        [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foob", "Zm9vYg=="), ("foobar", "Zm9vYmFy")]
    {
        if base64(bytes.as_bytes()) != text {
            return Err(format!("{bytes:?} is {:?}, not {text:?}", base64(bytes.as_bytes())).into());
        }
    }
    Ok(())
}
