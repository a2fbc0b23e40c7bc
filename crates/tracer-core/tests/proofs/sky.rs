//! A sphere that shines around all there is: a sky.

use crate::support::compare::assert_sharing_is_unbiased;
use crate::support::{compiled, film};
use scene_format::{SceneDesc, Syntax, load_str};
use std::path::Path;
use tracer_core::Film;

const SKY: &str = "Sphere(center: (1, 2, 3), radius: 300, material: Emissive(radiance: (0.5, 0.7, 0.9), \
     two_sided: true))";

/// A small sun and a near lamp.
const LAMPS: &str = "SphereLight(center: (60, 80, 40), radius: 0.5, radiance: 45000), \
     SphereLight(center: (-3, 4, 2), radius: 0.3, radiance: 12)";

/// A matt floor, balls of all materials, lamps; with a background or under a sky.
fn described([background, sky]: [&str; 2], lamps: &str, bounces: u32, integrator: &str) -> SceneDesc {
    seen_from("None", [background, sky], lamps, bounces, integrator)
}

/// The same, of which the camera does not see what is nearer.
fn seen_from(near: &str, [background, sky]: [&str; 2], lamps: &str, bounces: u32, integrator: &str) -> SceneDesc {
    let text = format!(
        "Scene(image: Image(width: 32, height: 32), background: {background}, \
         render: Render(max_bounces: {bounces}, integrator: {integrator}), \
         camera: Camera(position: (0, 3, 7), look_at: (0, 0.7, 0), fov: 40, near: {near}), \
         lights: [{lamps}], \
         objects: [{sky} Box(center: (0, -0.5, 0), size: (30, 1, 30)), \
             Sphere(center: (0, 1, 0), radius: 1, material: Diffuse(albedo: (0.8, 0.3, 0.2))), \
             Sphere(center: (-1.9, 0.8, 0.5), radius: 0.8, material: Transparent(ior: 1.5)), \
             Sphere(center: (1.8, 0.7, 0.6), radius: 0.7, material: BlinnPhong(albedo: 0.5, exponent: 80, \
                 specular: 0.3, energy_conserving: true)), \
             Sphere(center: (0.9, 0.4, 1.8), radius: 0.4, material: Conductor(reflectance: 0.9, roughness: 0.3))])"
    );
    load_str("s.ron", &text, Syntax::Ron, Path::new(""), &[]).unwrap_or_else(|error| panic!("{error}\n{text}")).scene
}

/// Means of the channels.
fn means(film: &Film) -> [f64; 3] {
    let [width, height] = [film.crop().width, film.crop().height];
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| film.radiance(x, y)));
    pixels.fold([0.0; 3], |sum, x| [0, 1, 2].map(|c| sum[c] + x[c] / f64::from(width * height)))
}

/// A sky of one colour is a background of that colour: in light, at every number of bounces, and of plain paths in
/// noise. The same paths find it, and roundings send few of them elsewhere: the means agree within three standard
/// errors of one of the pictures, and the noise within a tenth. Where rays are aimed and pixels share they are other
/// paths, and single bright ones over glass make the noise.
#[test]
fn a_sky_of_one_colour_is_a_background() {
    let (background, sky) = (["(0.5, 0.7, 0.9)", ""], ["0", &format!("{SKY},")]);
    for (integrator, lamps) in ["Path", "Full"].into_iter().flat_map(|of| ["", LAMPS].map(|lamps| (of, lamps))) {
        for bounces in [0, 1, 2, 6] {
            let of = |behind| film(&compiled(&described(behind, lamps, bounces, integrator)), 64, 1);
            let [background, sky] = [background, sky].map(of);
            let noises = [&background, &sky].map(Film::relative_noise);
            // Of the mean of so many pixels, were they independent; they are not quite.
            let error = 3.0 * f64::max(noises[0], noises[1]) / 32.0 + 1e-4;
            for (a, b) in means(&background).into_iter().zip(means(&sky)) {
                assert!((a - b).abs() < error * a, "{integrator}, {bounces} bounces: {a} and {b}, {noises:?}");
            }
            let ratio = noises[1] / noises[0];
            let is_alike = integrator == "Full" || (0.9..1.1).contains(&ratio);
            assert!(is_alike, "{integrator}, {bounces} bounces: noise {noises:?}");
        }
    }
}

/// Nor does sharing change it.
#[test]
fn sharing_under_a_sky_is_unbiased() {
    assert_sharing_is_unbiased("sky", &described(["0", &format!("{SKY},")], LAMPS, 4, "Full"), 1);
}

/// A camera that does not see the sphere looks in from outside, or it stands there, or its rays start there: then it
/// is a lamp as any other.
#[test]
fn a_lamp_that_is_seen_from_outside_is_no_sky() {
    let is_sky_from = |near: &str, sky: &str| {
        let scene = compiled(&seen_from(near, ["0", sky], LAMPS, 2, "Full"));
        scene.lights.iter().any(tracer_core::scene::Light::is_sky)
    };
    let is_sky = |sky: &str| is_sky_from("None", sky);
    assert!(is_sky(&format!("{SKY},")));
    assert!(is_sky_from("0.01", &format!("{SKY},")) && !is_sky_from("290", &format!("{SKY},")));
    for other in [
        SKY.replace("two_sided: true", "two_sided: false"),
        SKY.replace("radius: 300", "radius: 3"),
        SKY.replace("radius: 300", "radius: 300, camera_visible: false"),
    ] {
        assert!(!is_sky(&format!("{other},")), "{other}");
    }
}

/// What is bright beneath a glass ball is found as well in a lamp around all that is no sky as under a sky: photons go
/// where the lamps' light does. Nearly all were of the lamp around, so that rare rays had found what is bright: half of
/// the pixels were below 0.25 with it, and are below 0.40 under a sky, whatever the seed.
#[test]
fn a_lamp_around_all_leaves_photons_to_the_others() {
    let median = |seen: bool| {
        let text = format!(
            "Scene(image: Image(width: 32, height: 32), background: 0, \
             camera: Camera(position: (0, 4, 4), look_at: (-1, 0, -0.6), fov: 5), \
             lights: [SphereLight(center: (6, 8, 4), radius: 0.2, radiance: 3000)], \
             objects: [Plane(), Sphere(center: (0, 0.8, 0), radius: 0.8, material: Transparent(ior: 1.5)), \
                 Sphere(radius: 300, material: Emissive(radiance: 0.3, two_sided: true), camera_visible: {seen})])"
        );
        let scene = load_str("s.ron", &text, Syntax::Ron, Path::new(""), &[]).expect("a scene").scene;
        let scene = compiled(&scene);
        assert_eq!(scene.lights.iter().any(tracer_core::scene::Light::is_sky), seen);
        let film = film(&scene, 64, 3);
        let mut pixels: Vec<f64> = (0..32 * 32).map(|k| film.radiance(k % 32, k / 32)[0]).collect();
        pixels.sort_by(f64::total_cmp);
        pixels[512]
    };
    let [sky, lamp] = [true, false].map(median);
    assert!((lamp / sky - 1.0).abs() < 0.1, "{sky} and {lamp}");
}
