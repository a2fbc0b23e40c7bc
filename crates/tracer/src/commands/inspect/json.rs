//! A sample for programs: the numbers as they are.

use super::Explained;
use serde_json::{Value, json};
use tracer_core::{Ended, MetTold, SampledTold, Scattering, Told, VertexTold, Whole};

/// All that there is to say.
pub fn json(of: &Explained) -> Value {
    let told = &of.told;
    let path = &told.path;
    let contributions = of.contributions();
    let brings = contributions
        .iter()
        .map(|(vertex, by, radiance)| json!({ "vertex": vertex, "by": by, "radiance": radiance }))
        .collect::<Vec<_>>();
    json!({
        "scene": of.desc.sources.first().map(|source| source.name.as_str()),
        "pixel": told.pixel,
        "sample": told.sample,
        "path": {
            "camera": path.camera,
            "vertices": path.vertices.iter().enumerate().map(|(k, v)| vertex(of, k + 1, v)).collect::<Vec<_>>(),
            "contributions": brings,
            "radiance": path.radiance,
            "counts": path.counts,
            "agrees": path.agrees,
        },
        "whole": told.whole.as_ref().map(whole),
    })
}

fn vertex(of: &Explained, number: usize, vertex: &VertexTold) -> Value {
    json!({
        "number": number,
        "depth": vertex.depth,
        "from": vertex.from.map(|from| from + 1),
        "branch": vertex.is_branch,
        "origin": vertex.origin,
        "direction": vertex.direction,
        "throughput": vertex.throughput,
        "pdf": vertex.pdf,
        "hit": vertex.told.as_ref().map(|told| hit(of, told)),
        "met": vertex.met.as_ref().map(met),
        "sampled": vertex.sampled.as_ref().map(|light| sampled(of, light)),
        "scattering": vertex.scattering.as_ref().map(scattering),
        "ended": vertex.ended.map(ended),
    })
}

fn hit(of: &Explained, told: &Told) -> Value {
    json!({
        "point": told.point,
        "normal": told.normal,
        "geometric_normal": told.geometric,
        "distance": told.distance,
        "object": told.object.map(|number| of.object(number)),
        "object_id": told.object.map(|number| number + 1),
        "material": told.material.and_then(|number| of.material(number)),
        "material_id": told.material.map(|number| number + 1),
        "light": told.is_light,
        "color": told.color,
        "outside": told.is_outside,
        "glass": told.glass.map(|[reflectance, ior]| json!({ "reflectance": reflectance, "ior": ior })),
    })
}

fn met(met: &MetTold) -> Value {
    json!({ "radiance": met.radiance, "light_pdf": met.light_pdf, "weight": met.weight, "brings": met.brings })
}

fn sampled(of: &Explained, light: &SampledTold) -> Value {
    json!({
        "light": of.light(light.light),
        "point": light.point,
        "direction": light.direction,
        "pdf": light.pdf,
        "material_pdf": light.material_pdf,
        "weight": light.weight,
        "f": light.f,
        "radiance": light.radiance,
        "cos": light.cos,
        "arrives": light.arrives,
        "brings": light.brings(),
    })
}

fn scattering(scattering: &Scattering) -> Value {
    let roulette = scattering.roulette.as_ref();
    json!({
        "lobe": scattering.lobe,
        "direction": scattering.direction,
        "pdf": scattering.pdf,
        "weight": scattering.weight,
        "roulette": roulette.map(|by| json!({ "survival": by.survival, "drawn": by.drawn })),
    })
}

fn ended(ended: Ended) -> &'static str {
    match ended {
        Ended::Left => "left",
        Ended::AtLight => "light",
        Ended::Bounces => "max_bounces",
        Ended::Direct => "direct",
        Ended::Roulette => "roulette",
        _ => "nothing",
    }
}

fn whole(whole: &Whole) -> Value {
    let brought = whole.brought.iter().map(|by| json!({ "by": by.by, "radiance": by.radiance }));
    json!({
        "brought": brought.collect::<Vec<_>>(),
        "rounding": whole.rounding,
        "clamping": whole.taken.map(|x| -x),
        "radiance": whole.radiance,
        "aimed_rays": whole.aimed,
        "shared": whole.shared.map(|s| json!({ "pixels": s.pixels, "found": s.found, "used": s.seen })),
        "agrees": whole.agrees,
    })
}
