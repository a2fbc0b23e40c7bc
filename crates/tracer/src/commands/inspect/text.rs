//! A sample for people.

use super::Explained;
use std::fmt::Write;
use tracer_core::{Ended, MetTold, SampledTold, Scattering, Told, VertexTold, Whole};

/// All that there is to say.
pub fn text(of: &Explained) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = write(of, &mut out);
    out
}

fn write(of: &Explained, out: &mut String) -> std::fmt::Result {
    let told = &of.told;
    let name = of.desc.sources.first().map_or("", |source| source.name.as_str());
    let [x, y] = told.pixel;
    writeln!(out, "{name}, pixel {x},{y}, sample {}", told.sample)?;
    writeln!(out, "\nThe path of the plain path tracer")?;
    match told.path.camera {
        Some(camera) => writeln!(out, "  the camera's ray starts at {}", point(camera))?,
        None => writeln!(out, "  the camera shows nothing there")?,
    }
    for (k, vertex) in told.path.vertices.iter().enumerate() {
        of_vertex(of, k + 1, vertex, out)?;
    }
    writeln!(out, "\nWhat it brings, in W/(sr m^2)")?;
    let contributions = of.contributions();
    for (vertex, by, brings) in &contributions {
        let by = format!("{vertex}, {by}");
        writeln!(out, "  {by:<20} {}", exact(*brings))?;
    }
    writeln!(out, "  {:<20} {}", "sum", exact(told.path.radiance))?;
    if told.path.counts != told.path.radiance {
        writeln!(out, "  {:<20} {}", "clamped to", exact(told.path.counts))?;
    }
    if told.path.agrees {
        writeln!(out, "  The batch that makes pictures has the same sum, to the bit.")?;
    }
    match &told.whole {
        Some(whole) => of_whole(whole, out),
        None => Ok(()),
    }
}

fn of_vertex(of: &Explained, number: usize, vertex: &VertexTold, out: &mut String) -> std::fmt::Result {
    let from = vertex.from.map_or("the camera".to_owned(), |from| format!("{}", from + 1));
    let branch = if vertex.is_branch { ", the fainter way at glass" } else { "" };
    match &vertex.told {
        Some(told) => of_hit(of, number, told, &from, branch, out)?,
        None => writeln!(out, "\n{number}  leaves the scene\n   from {from}{branch} to {}", short(vertex.direction))?,
    }
    let pdf = vertex.pdf.map_or("the only way".to_owned(), |pdf| format!("pdf {}", digits(pdf)));
    writeln!(out, "   ray: throughput {}, {pdf}", short(vertex.throughput))?;
    if let Some(met) = &vertex.met {
        of_met(met, out)?;
    }
    if let Some(sampled) = &vertex.sampled {
        of_sampled(of, sampled, out)?;
    }
    if let Some(scattering) = &vertex.scattering {
        of_scattering(scattering, out)?;
    }
    if let Some(ended) = vertex.ended {
        writeln!(out, "   ends: {}", why(ended))?;
    }
    Ok(())
}

fn of_hit(of: &Explained, number: usize, told: &Told, from: &str, branch: &str, out: &mut String) -> std::fmt::Result {
    let object = told.object.map_or("something".to_owned(), |number| of.object(number));
    let material = match told.material {
        _ if told.is_light => ", a light".to_owned(),
        Some(material) => of.material(material).map_or(String::new(), |name| format!(", material {name}")),
        None => String::new(),
    };
    let side = if told.is_outside { "" } else { ", from within" };
    writeln!(out, "\n{number}  {object}{material}{side}")?;
    writeln!(out, "   at {}, {} from {from}{branch}", point(told.point), digits(told.distance))?;
    let normal = short(told.normal);
    if told.normal == told.geometric {
        writeln!(out, "   normal {normal}")?;
    } else {
        writeln!(out, "   normal {normal}, of the triangle {}", short(told.geometric))?;
    }
    if let Some([reflectance, ior]) = told.glass {
        writeln!(out, "   glass of index {}: reflects {}", digits(ior), digits(reflectance))?;
    }
    Ok(())
}

fn of_met(met: &MetTold, out: &mut String) -> std::fmt::Result {
    let beside = match met.light_pdf {
        Some(pdf) => format!("light samples have pdf {}, weight {}", digits(pdf), digits(met.weight)),
        None => "no light sample could, weight 1".to_owned(),
    };
    writeln!(out, "   light met: radiance {}, {beside}", short(met.radiance))?;
    writeln!(out, "     brings {}", exact(met.brings))
}

fn of_sampled(of: &Explained, sampled: &SampledTold, out: &mut String) -> std::fmt::Result {
    let at =
        sampled.point.map_or_else(|| format!("towards {}", short(sampled.direction)), |p| format!("at {}", point(p)));
    writeln!(out, "   light sampled: {} {at}, pdf {}", of.light(sampled.light), digits(sampled.pdf))?;
    if sampled.arrives.is_none() {
        return writeln!(out, "     nothing comes from there: no ray is cast");
    }
    writeln!(
        out,
        "     f {}, cosine {}, radiance {}, the material's pdf {}, weight {}",
        short(sampled.f),
        digits(sampled.cos),
        short(sampled.radiance),
        digits(sampled.material_pdf),
        digits(sampled.weight)
    )?;
    match sampled.arrives {
        Some(true) => writeln!(out, "     is seen: brings {}", exact(sampled.carries)),
        _ => writeln!(out, "     is hidden: brings nothing"),
    }
}

fn of_scattering(scattering: &Scattering, out: &mut String) -> std::fmt::Result {
    let pdf = scattering.pdf.map_or(String::new(), |pdf| format!(", pdf {}", digits(pdf)));
    let (lobe, to) = (scattering.lobe, short(scattering.direction));
    writeln!(out, "   scattered: {lobe} to {to}{pdf}, weight {}", short(scattering.weight))?;
    let Some(roulette) = &scattering.roulette else { return Ok(()) };
    let verdict = if roulette.drawn < roulette.survival { "goes on" } else { "ends" };
    writeln!(
        out,
        "   roulette: goes on below {}, drawn {}: {verdict}",
        digits(roulette.survival),
        digits(roulette.drawn)
    )
}

fn why(ended: Ended) -> &'static str {
    match ended {
        Ended::Left => "nothing is there",
        Ended::AtLight => "lights reflect nothing",
        Ended::Bounces => "max_bounces is reached",
        Ended::Direct => "direct light only",
        Ended::Roulette => "by roulette",
        Ended::Nothing => "nothing is scattered that way",
        _ => "it is over",
    }
}

fn of_whole(whole: &Whole, out: &mut String) -> std::fmt::Result {
    writeln!(out, "\nThe same sample with all that the scene asks for (integrator: Full), in W/(sr m^2)")?;
    for brought in &whole.brought {
        let note = match (brought.by, &whole.shared) {
            ("sharing", Some(shared)) => format!(
                "  ({} pixels share {} second vertices, of which this one uses {})",
                shared.pixels, shared.found, shared.seen
            ),
            ("aimed rays", _) => format!("  (rays: {})", whole.aimed),
            _ => String::new(),
        };
        writeln!(out, "  {:<20} {}{note}", brought.by, exact(brought.radiance))?;
    }
    writeln!(out, "  {:<20} {}", "rounding", exact(whole.rounding))?;
    if whole.taken != [0.0; 3] {
        writeln!(out, "  {:<20} {}", "clamping", exact(whole.taken.map(|x| -x)))?;
    }
    writeln!(out, "  {:<20} {}", "sum", exact(whole.radiance))?;
    if whole.agrees {
        writeln!(out, "  The film of this pixel and sample has this sum.")?;
    }
    Ok(())
}

/// A number for the eye: five digits.
pub fn digits(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    if !x.is_finite() {
        return "infinity".to_owned();
    }
    let size = x.abs();
    if !(1e-4..1e6).contains(&size) {
        return format!("{x:.4e}");
    }
    let places = (4 - size.log10().floor() as i32).clamp(0, 8) as usize;
    let text = format!("{x:.places$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

fn short(x: [f64; 3]) -> String {
    format!("({}, {}, {})", digits(x[0]), digits(x[1]), digits(x[2]))
}

fn point(x: [f64; 3]) -> String {
    short(x)
}

/// As many digits as tell the number from all others in single precision; where it is none, in double.
fn exact(x: [f64; 3]) -> String {
    let number = |x: f64| {
        let single = x as f32;
        let is_plain = |text: String| if text.len() > 14 { format!("{single:e}") } else { text };
        match x.abs() {
            _ if f64::from(single) == x => is_plain(format!("{single}")),
            1e-3..1e6 => format!("{x:.8}"),
            _ => format!("{x:.6e}"),
        }
    };
    format!("({}, {}, {})", number(x[0]), number(x[1]), number(x[2]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_or_exact() {
        for (x, text) in [(0.0, "0"), (1.0, "1"), (-12.345678, "-12.346"), (1e-7, "1.0000e-7"), (123456.0, "123456")] {
            assert_eq!(digits(x), text);
        }
        assert_eq!(exact([0.1f32.into(), 0.0, 1.5]), "(0.1, 0, 1.5)");
    }
}
