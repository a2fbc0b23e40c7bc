//! `EXT_mesh_gpu_instancing`: a mesh of a node as often as accessors say.

use super::accessor::Buffers;
use crate::cursor::Fault;
use glam::{DAffine3, DQuat, DVec3, DVec4};
use serde::Deserialize;

/// Bytes that it takes to place a mesh, or as much work.
const PLACED: u64 = 256;

#[derive(Deserialize)]
pub(super) struct Instancing {
    attributes: Attributes,
}

#[derive(Deserialize)]
#[serde(rename_all = "UPPERCASE")]
struct Attributes {
    translation: Option<u32>,
    rotation: Option<u32>,
    scale: Option<u32>,
}

impl Instancing {
    /// From each instance to its node; the node stands at a byte, and its mesh has so many bytes of words, which each
    /// instance reads anew.
    pub(super) fn placements(
        &self,
        buffers: &mut Buffers<'_>,
        words: u64,
        at: usize,
    ) -> Result<Vec<DAffine3>, Box<Fault>> {
        let Attributes { translation, rotation, scale } = self.attributes;
        let mut of_three = |accessor: Option<u32>, what: &str| {
            accessor.map(|accessor| buffers.values::<3>(accessor, at, what)).transpose()
        };
        let (translations, scales) = (of_three(translation, "TRANSLATION")?, of_three(scale, "SCALE")?);
        let rotations = rotation.map(|accessor| buffers.values::<4>(accessor, at, "ROTATION")).transpose()?;
        let counts: Vec<usize> = [
            translations.as_ref().map(|values| values.count),
            scales.as_ref().map(|values| values.count),
            rotations.as_ref().map(|values| values.count),
        ]
        .into_iter()
        .flatten()
        .collect();
        let count = counts.first().copied().unwrap_or(0);
        if counts.iter().any(|other| *other != count) {
            let message = "the attributes of EXT_mesh_gpu_instancing have different numbers of elements";
            return Err(Fault::new(at, message, "as many of each as there are instances"));
        }
        buffers.spend(words.saturating_add(PLACED).saturating_mul(count as u64), at)?;
        let placement = |k: usize| {
            let translation = translations.as_ref().map_or(Ok([0.0; 3]), |values| values.get(k))?;
            let scale = scales.as_ref().map_or(Ok([1.0; 3]), |values| values.get(k))?;
            let rotation = rotations.as_ref().map_or(Ok([0.0, 0.0, 0.0, 1.0]), |values| values.get(k))?;
            let Some(rotation) = DVec4::from(rotation).try_normalize() else {
                let message = format!("rotation {k} of EXT_mesh_gpu_instancing is zero");
                return Err(Fault::new(at, message, "a quaternion of length one"));
            };
            let (scale, rotation) = (DVec3::from(scale), DQuat::from_vec4(rotation));
            Ok(DAffine3::from_scale_rotation_translation(scale, rotation, DVec3::from(translation)))
        };
        (0..count).map(placement).collect()
    }
}
