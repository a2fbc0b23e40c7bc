//! As much of Embree 3's C interface as a comparison needs.

use crate::sets::{Answers, Mesh, Set};
use std::ffi::{c_int, c_uint, c_void};
use std::ptr::{null, null_mut};

type Handle = *mut c_void;

unsafe extern "C" {
    fn rtcNewDevice(config: *const i8) -> Handle;
    fn rtcGetDeviceProperty(device: Handle, property: c_int) -> isize;
    fn rtcGetDeviceError(device: Handle) -> c_int;
    fn rtcReleaseDevice(device: Handle);
    fn rtcNewScene(device: Handle) -> Handle;
    fn rtcSetSceneFlags(scene: Handle, flags: c_int);
    fn rtcSetSceneBuildQuality(scene: Handle, quality: c_int);
    fn rtcCommitScene(scene: Handle);
    fn rtcReleaseScene(scene: Handle);
    fn rtcNewGeometry(device: Handle, kind: c_int) -> Handle;
    fn rtcSetSharedGeometryBuffer(
        geometry: Handle,
        kind: c_int,
        slot: c_uint,
        format: c_int,
        data: *const c_void,
        offset: usize,
        stride: usize,
        count: usize,
    );
    fn rtcCommitGeometry(geometry: Handle);
    fn rtcAttachGeometry(scene: Handle, geometry: Handle) -> c_uint;
    fn rtcReleaseGeometry(geometry: Handle);
    fn rtcIntersect1(scene: Handle, context: *mut Context, ray: *mut RayHit<1>);
    fn rtcOccluded1(scene: Handle, context: *mut Context, ray: *mut Ray<1>);
    fn rtcIntersect16(valid: *const c_int, scene: Handle, context: *mut Context, ray: *mut RayHit<16>);
    fn rtcOccluded16(valid: *const c_int, scene: Handle, context: *mut Context, ray: *mut Ray<16>);
}

#[repr(C)]
struct Context {
    flags: c_int,
    filter: *const c_void,
    instance: c_uint,
}

#[repr(C, align(64))]
#[derive(Clone, Copy)]
struct Ray<const N: usize> {
    origin_x: [f32; N],
    origin_y: [f32; N],
    origin_z: [f32; N],
    near: [f32; N],
    direction_x: [f32; N],
    direction_y: [f32; N],
    direction_z: [f32; N],
    time: [f32; N],
    far: [f32; N],
    mask: [u32; N],
    id: [u32; N],
    flags: [u32; N],
}

/// 16 bytes are all that a single ray is aligned to, so its hit follows at byte 48.
#[repr(C)]
#[derive(Clone, Copy)]
struct Hit<const N: usize> {
    normal: [[f32; N]; 3],
    u: [f32; N],
    v: [f32; N],
    primitive: [u32; N],
    geometry: [u32; N],
    instance: [u32; N],
}

#[repr(C, align(64))]
struct RayHit<const N: usize> {
    /// A `Ray<N>` without its padding.
    ray: [[u32; N]; 12],
    hit: Hit<N>,
}

impl<const N: usize> Ray<N> {
    fn of(set: &Set, start: usize) -> Self {
        let lane = |values: &[f32]| std::array::from_fn(|k| values.get(start + k).copied().unwrap_or(0.0));
        let far = if set.tmax.is_empty() { [f32::INFINITY; N] } else { lane(&set.tmax) };
        Self {
            origin_x: lane(&set.origin[0]),
            origin_y: lane(&set.origin[1]),
            origin_z: lane(&set.origin[2]),
            near: [0.0; N],
            direction_x: lane(&set.direction[0]),
            direction_y: lane(&set.direction[1]),
            direction_z: lane(&set.direction[2]),
            time: [0.0; N],
            far,
            mask: [u32::MAX; N],
            id: [0; N],
            flags: [0; N],
        }
    }
}

impl<const N: usize> RayHit<N> {
    fn of(set: &Set, start: usize) -> Self {
        let ray = Ray::<N>::of(set, start);
        let bits = |values: [f32; N]| values.map(f32::to_bits);
        let none = [u32::MAX; N];
        Self {
            ray: [
                bits(ray.origin_x),
                bits(ray.origin_y),
                bits(ray.origin_z),
                bits(ray.near),
                bits(ray.direction_x),
                bits(ray.direction_y),
                bits(ray.direction_z),
                bits(ray.time),
                bits(ray.far),
                ray.mask,
                ray.id,
                ray.flags,
            ],
            hit: Hit {
                normal: [[0.0; N]; 3],
                u: [0.0; N],
                v: [0.0; N],
                primitive: none,
                geometry: none,
                instance: none,
            },
        }
    }
}

/// How to ask.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Way {
    Single,
    Packets { coherent: bool },
}

/// Embree, with one mesh committed.
pub struct Embree {
    device: Handle,
    scene: Handle,
    pub seconds: f64,
}

impl Embree {
    /// `positions` must have one vertex more than the mesh: Embree reads 16 bytes for each.
    pub fn new(mesh: &Mesh, high_quality: bool, robust: bool) -> Self {
        assert!(mesh.triangles.iter().flatten().all(|&v| (v as usize) + 1 < mesh.positions.len()));
        // SAFETY: the calls of Embree's manual in its order; the mesh outlives the scene (main keeps both).
        unsafe {
            let device = rtcNewDevice(null());
            assert!(!device.is_null(), "no Embree device");
            let scene = rtcNewScene(device);
            rtcSetSceneFlags(scene, if robust { 4 } else { 0 });
            rtcSetSceneBuildQuality(scene, if high_quality { 2 } else { 1 });
            let geometry = rtcNewGeometry(device, 0);
            let (vertices, triangles) = (&mesh.positions, &mesh.triangles);
            rtcSetSharedGeometryBuffer(geometry, 1, 0, 0x9003, vertices.as_ptr().cast(), 0, 12, vertices.len() - 1);
            rtcSetSharedGeometryBuffer(geometry, 0, 0, 0x5003, triangles.as_ptr().cast(), 0, 12, triangles.len());
            let start = std::time::Instant::now();
            rtcCommitGeometry(geometry);
            rtcAttachGeometry(scene, geometry);
            rtcReleaseGeometry(geometry);
            rtcCommitScene(scene);
            let seconds = start.elapsed().as_secs_f64();
            assert_eq!(rtcGetDeviceError(device), 0, "Embree reports an error");
            Self { device, scene, seconds }
        }
    }

    pub fn version(&self) -> String {
        // SAFETY: properties 1 to 3 are the parts of the version.
        let part = |property| unsafe { rtcGetDeviceProperty(self.device, property) };
        format!("{}.{}.{}", part(1), part(2), part(3))
    }

    pub fn trace(&self, set: &Set, way: Way, answers: &mut Answers) {
        let coherent = way == Way::Packets { coherent: true };
        let mut context = Context { flags: c_int::from(coherent), filter: null(), instance: u32::MAX };
        match (way, set.tmax.is_empty()) {
            (Way::Single, true) => {
                for i in 0..set.len() {
                    let mut ray = RayHit::<1>::of(set, i);
                    // SAFETY: a committed scene and a ray as rtcore_ray.h lays it out.
                    unsafe { rtcIntersect1(self.scene, &mut context, &mut ray) };
                    answers.t[i] = f32::from_bits(ray.ray[8][0]);
                    answers.primitive[i] = ray.hit.primitive[0];
                }
            }
            (Way::Single, false) => {
                for i in 0..set.len() {
                    let mut ray = Ray::<1>::of(set, i);
                    // SAFETY: as above.
                    unsafe { rtcOccluded1(self.scene, &mut context, &mut ray) };
                    answers.occluded[i] = u32::from(ray.far[0] == f32::NEG_INFINITY);
                }
            }
            (_, true) => {
                for i in (0..set.len()).step_by(16) {
                    let mut ray = RayHit::<16>::of(set, i);
                    let valid = Valid::of(set.len() - i);
                    // SAFETY: as above, aligned to 64 bytes.
                    unsafe { rtcIntersect16(valid.0.as_ptr(), self.scene, &mut context, &mut ray) };
                    for k in 0..16.min(set.len() - i) {
                        answers.t[i + k] = f32::from_bits(ray.ray[8][k]);
                        answers.primitive[i + k] = ray.hit.primitive[k];
                    }
                }
            }
            (_, false) => {
                for i in (0..set.len()).step_by(16) {
                    let mut ray = Ray::<16>::of(set, i);
                    let valid = Valid::of(set.len() - i);
                    // SAFETY: as above.
                    unsafe { rtcOccluded16(valid.0.as_ptr(), self.scene, &mut context, &mut ray) };
                    for k in 0..16.min(set.len() - i) {
                        answers.occluded[i + k] = u32::from(ray.far[k] == f32::NEG_INFINITY);
                    }
                }
            }
        }
    }
}

#[repr(C, align(64))]
struct Valid([c_int; 16]);

impl Valid {
    fn of(left: usize) -> Self {
        Self(std::array::from_fn(|k| if k < left { -1 } else { 0 }))
    }
}

impl Drop for Embree {
    fn drop(&mut self) {
        // SAFETY: both were created by `new` and are released once.
        unsafe {
            rtcReleaseScene(self.scene);
            rtcReleaseDevice(self.device);
        }
        self.scene = null_mut();
    }
}
