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

/// Dark, so that a dark picture's edge shows; figures stand side by side where there is room and below each other where there is not.
const STYLE: &str = "body{font:14px/1.4 sans-serif;background:#222;color:#ddd;margin:16px}h1{margin:0}\
    main{display:flex;flex-wrap:wrap;gap:16px 24px;margin:16px 0}figure{margin:0;max-width:100%}figcaption{margin-top:4px}\
    img{width:100%;image-rendering:pixelated;background:#000;display:block}\
    #wipe{position:relative;cursor:ew-resize;touch-action:none;--at:50%}#top{position:absolute;left:0;top:0;clip-path:inset(0 0 0 var(--at))}\
    #wipe::after{content:'';position:absolute;top:0;bottom:0;left:var(--at);width:1px;background:#fff}\
    input{width:100%;margin:8px 0 0}#scale{height:10px}pre,ol{background:#111;padding:8px;overflow:auto;margin:4px 0 16px}\
    ol{font-family:monospace;white-space:pre;padding-left:56px}li::marker{color:#888}";

/// The wipe follows the slider and the pointer over the pictures.
const SCRIPT: &str = "const box=document.getElementById('wipe'),bar=document.querySelector('input'),\
    show=v=>{bar.value=v;box.style.setProperty('--at',bar.value+'%')};bar.oninput=()=>show(bar.value);\
    box.onpointermove=box.onpointerdown=e=>{const r=box.getBoundingClientRect();show(100*(e.clientX-r.left)/r.width)};";

/// The width at which a picture is shown: a whole number of screen pixels per pixel, about 384 in all.
fn shown_width(picture: &Picture) -> u32 {
    picture.width * (384 / picture.width).max(1)
}

impl Page<'_> {
    /// The page as HTML.
    pub fn html(&self) -> Result<String, Failed> {
        let Page { name, what, scene, actual, expected } = self;
        let mut page = format!(
            "<!doctype html>\n<html lang=en>\n<meta charset=utf-8>\n<meta name=viewport content=\"width=device-width\">\n\
             <title>{0}</title>\n<style>{STYLE}</style>\n<h1>{0}</h1>\n<p>{1}</p>\n<main>\n",
            escaped(name),
            escaped(what)
        );
        let of_one_size = expected.filter(|e| (e.width, e.height) == (actual.width, actual.height));
        if let Some(expected) = expected {
            figure(&mut page, expected, "expected", "")?;
        }
        figure(&mut page, actual, "actual", "")?;
        if let Some(expected) = of_one_size {
            let width = shown_width(actual);
            let _ = writeln!(
                page,
                "<figure style=width:{width}px><div id=wipe><img alt=expected src=\"{}\"><img id=top alt=actual src=\"{}\"></div>\
                 <input type=range value=50 step=any aria-label=wipe><figcaption>wipe: expected | actual</figcaption></figure>",
                data(expected)?,
                data(actual)?
            );
            figure(&mut page, &difference(actual, expected).picture, "difference, times 8", "")?;
            let (map, mean, largest) = flip_map(expected, actual);
            let caption = format!("FLIP, what the eye sees: mean {mean:.4}, largest {largest:.4}");
            figure(&mut page, &map, &caption, &false_colours())?;
        }
        page.push_str("</main>\n");
        if of_one_size.is_some() {
            let _ = writeln!(page, "<script>{SCRIPT}</script>");
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

/// A picture with what it shows below it, and below that what explains its colours.
fn figure(page: &mut String, picture: &Picture, caption: &str, legend: &str) -> Result<(), Failed> {
    let (width, caption) = (shown_width(picture), escaped(caption));
    let _ = writeln!(
        page,
        "<figure style=width:{width}px><img alt=\"{caption}\" src=\"{}\"><figcaption>{caption}</figcaption>{legend}</figure>",
        data(picture)?
    );
    Ok(())
}

/// The colours of the FLIP map from 0 to 1, as a bar.
fn false_colours() -> String {
    let stops: Vec<String> = (0..=8)
        .map(|k| {
            let [r, g, b] = magma(k as f32 / 8.0).map(|c| (c * 255.0 + 0.5) as u8);
            format!("rgb({r} {g} {b})")
        })
        .collect();
    format!("<div id=scale style=\"background:linear-gradient(90deg,{})\"></div>0 to 1", stops.join(","))
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
        ("difference, times 8", 2),
        // The picture's alternative text, and its caption.
        ("FLIP, what the eye sees", 2),
        ("linear-gradient(", 1),
        ("<script>", 1),
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
    if alone.matches("<img ").count() != 1 || alone.contains("<script>") {
        return Err(format!("one picture and no wipe were expected in\n{alone}").into());
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
