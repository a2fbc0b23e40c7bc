//! Marks: the pixel that shows a point is the one whose ray has met it, by every camera, and what is behind is hidden.

use crate::support::compiled;
use crate::support::describe::*;
use scene_format::SceneDesc;
use scene_format::desc::{FisheyeMapping, Mark, PixelFilter, Projection, Stereo, StereoLayout};
use tracer_core::{Eye, Layer, LayerSet, MarkSeen, RenderOptions, Scene, Unobserved, marks, render};

fn view(projection: Projection) -> SceneDesc {
    let balls = [[0.0, 0.0, 0.0], [1.4, 0.3, -1.0], [-1.0, -0.8, 0.5], [0.4, 1.2, 2.0]];
    let objects = balls.map(|center| sphere(center, 0.7, diffuse([0.5; 3]))).to_vec();
    let mut desc = scene(24, vec![light([0.0, 9.0, 0.0], 1.0, [5.0; 3])], objects).filter(PixelFilter::None);
    desc.image.height = 18.into();
    desc.camera.position = [0.3, 0.4, 5.0].into();
    desc.camera.look_at = [0.1, 0.0, 0.0].into();
    desc.camera.projection = projection;
    desc
}

/// The points that pixels show, and their depths.
fn shown(scene: &Scene) -> Vec<([f64; 2], [f64; 3], f64)> {
    let layers = Some(LayerSet::from_iter([Layer::Position, Layer::Depth]));
    let options = RenderOptions { samples: Some(1), layers, threads: 1, ..RenderOptions::default() };
    let film = render(scene, &options, &Unobserved);
    let [points, depths] = [Layer::Position, Layer::Depth].map(|layer| film.layer(layer).expect("asked for").values);
    let width = scene.size[0] as usize;
    let pixel = |k: usize| [(k % width) as f64 + 0.5, (k / width) as f64 + 0.5];
    let all = points.as_chunks::<3>().0.iter().zip(depths).enumerate();
    let hits = all.filter(|(_, (_, depth))| depth.is_finite());
    hits.map(|(k, (point, depth))| (pixel(k), point.map(f64::from), f64::from(depth))).collect()
}

fn seen(desc: &mut SceneDesc, scene: &mut Scene, points: &[[f64; 3]]) -> Vec<MarkSeen> {
    let mark = |point: &[f64; 3]| Mark { name: "a".to_owned().into(), point: (*point).into() };
    desc.output.marks = points.iter().map(mark).collect();
    marks(scene, desc)
}

#[test]
fn marks_are_where_they_are_seen() {
    let fisheye = |mapping| Projection::Fisheye { fov: 150.0.into(), mapping };
    for projection in [
        Projection::Perspective,
        Projection::Orthographic { height: 5.0.into() },
        Projection::Panorama,
        fisheye(FisheyeMapping::Equidistant),
        fisheye(FisheyeMapping::Equisolid),
        fisheye(FisheyeMapping::Stereographic),
        fisheye(FisheyeMapping::Orthographic),
    ] {
        let mut desc = view(projection.clone());
        if projection == Projection::Perspective {
            desc.camera.shift = [0.2, -0.1].into();
        }
        let mut scene = compiled(&desc);
        let before = (scene.camera, scene.size, scene.max_bounces);
        let shown = shown(&scene);
        assert!(shown.len() >= 4, "{projection:?}");
        let eye = desc.camera.position.value;
        let points: Vec<[f64; 3]> = shown.iter().map(|(_, point, _)| *point).collect();
        let found = seen(&mut desc, &mut scene, &points);
        for ((pixel, point, depth), mark) in shown.iter().zip(&found) {
            let at = mark.pixel.expect("it is seen");
            let off = (0..2).map(|axis| (at[axis] - pixel[axis]).abs()).fold(0.0, f64::max);
            assert!(off < 0.01, "{projection:?}: {point:?} at {at:?}, not {pixel:?}");
            assert!((mark.depth - depth).abs() < 1e-4 * depth && mark.seen, "{projection:?}: {mark:?} {depth}");
        }
        // A step further along their rays all are hidden, and a step nearer none.
        let forward = [0, 1, 2].map(|k| scene.camera.forward.to_array()[k]);
        let is_flat = matches!(projection, Projection::Orthographic { .. });
        let along = |step: f64| -> Vec<[f64; 3]> {
            let moved = |p: &[f64; 3]| {
                [0, 1, 2].map(|k| if is_flat { p[k] + step * forward[k] } else { p[k] + step * (p[k] - eye[k]) })
            };
            points.iter().map(moved).collect()
        };
        assert!(seen(&mut desc, &mut scene, &along(0.05)).iter().all(|mark| !mark.seen), "{projection:?}");
        let nearer = seen(&mut desc, &mut scene, &along(-0.05));
        assert!(nearer.iter().all(|mark| mark.seen), "{projection:?}");
        assert!(nearer.iter().zip(&shown).all(|(mark, (pixel, ..))| {
            mark.pixel.is_some_and(|at| (0..2).all(|axis| (at[axis] - pixel[axis]).abs() < 0.01))
        }));
        assert_eq!((scene.camera, scene.size, scene.max_bounces), before);
    }
}

/// Each eye has a place of its own for a mark, in its own half, and knows whether it sees it.
#[test]
fn two_eyes_have_two_places() {
    for projection in [Projection::Perspective, Projection::Panorama] {
        for layout in [StereoLayout::SideBySide, StereoLayout::TopBottom] {
            let mut desc = view(projection.clone());
            let near = projection == Projection::Perspective;
            let convergence = near.then(|| 4.0.into());
            desc.camera.stereo = Some(Stereo { separation: 0.8.into(), convergence, layout });
            let mut scene = compiled(&desc);
            let shown = shown(&scene);
            let points: Vec<[f64; 3]> = shown.iter().map(|(_, point, _)| *point).collect();
            let found = seen(&mut desc, &mut scene, &points);
            assert!(shown.len() > 4 && found.len() == 2 * shown.len());
            let axis = usize::from(layout == StereoLayout::TopBottom);
            let border = f64::from(scene.size[axis]) / 2.0;
            for ((pixel, point, depth), marks) in shown.iter().zip(found.chunks(2)) {
                assert_eq!([marks[0].eye, marks[1].eye], [Some(Eye::Left), Some(Eye::Right)]);
                let mark = &marks[usize::from(pixel[axis] > border)];
                let at = mark.pixel.expect("it is seen");
                let off = (0..2).map(|axis| (at[axis] - pixel[axis]).abs()).fold(0.0, f64::max);
                assert!(off < 0.01, "{projection:?} {layout:?}: {point:?} at {at:?}, not {pixel:?}");
                assert!((mark.depth - depth).abs() < 1e-4 * depth && mark.seen, "{mark:?} {depth}");
            }
        }
    }
}

#[test]
fn what_cannot_be_shown_has_no_pixel() {
    let mut desc = view(Projection::Perspective);
    let mut scene = compiled(&desc);
    let found = seen(&mut desc, &mut scene, &[[0.3, 0.4, 9.0], [90.0, 0.0, 0.0], [0.3, 0.4, 4.9]]);
    assert_eq!((found[0].pixel, found[0].seen), (None, false));
    assert!(found[1].pixel.is_some_and(|[x, _]| x > 24.0) && !found[1].seen, "{:?}", found[1]);
    assert!(found[2].seen);
    // Nearer than `near` nothing is.
    desc.camera.near = Some(0.5.into());
    let mut scene = compiled(&desc);
    assert!(!seen(&mut desc, &mut scene, &[[0.3, 0.4, 4.9]])[0].seen);
}
