//! A scene while its camera's shutter is open: read again, at other times.

use super::{Animation, Camera, SceneDesc};
use crate::diagnostic::{Diagnostics, Source};
use std::fmt::Debug;
use std::sync::Arc;

/// What a scene is read of.
pub(crate) trait Texts: Debug + Send + Sync {
    /// The scene as it is so large a share of a frame after its frame's beginning, or what is wrong with it.
    fn scene(&self, share: f64) -> Result<SceneDesc, Diagnostics>;

    /// The texts.
    fn sources(&self) -> &[Source];
}

/// What a scene is read of again at other times, where its camera has a shutter and something goes by `time`; nothing
/// where neither is so, and in scenes that were built in code. Two of them are the same if they are of one reading.
#[derive(Clone, Debug, Default)]
pub struct Moments(Option<Arc<Read>>);

#[derive(Debug)]
struct Read {
    texts: Box<dyn Texts>,
    /// The camera as the texts say it at the frame's beginning.
    camera: Camera,
}

impl Moments {
    pub(crate) fn new(texts: Box<dyn Texts>, scene: &SceneDesc) -> Self {
        Moments(Some(Arc::new(Read { texts, camera: scene.camera.clone() })))
    }
}

impl PartialEq for Moments {
    fn eq(&self, other: &Self) -> bool {
        match (&self.0, &other.0) {
            (None, None) => true,
            (Some(a), Some(b)) => Arc::ptr_eq(a, b) || a.texts.sources() == b.texts.sources(),
            _ => false,
        }
    }
}

impl SceneDesc {
    /// Whether anything moves while the camera's shutter is open.
    pub fn moves(&self) -> bool {
        self.camera.shutter.value > 0.0 && self.moments.0.is_some()
    }

    /// The scene as it is so large a share of a frame after the frame's beginning: read again from the texts that it
    /// was read from. Its picture, `render`, `output`, exposure and tone map are those of this one, whatever they are
    /// then; so is a camera that was changed since it was read. What else was changed since counts here no more. Of a
    /// scene in which nothing moves it is the scene itself.
    ///
    /// ```
    /// use scene_format::{Syntax, desc::Object, load_str};
    /// use std::path::Path;
    ///
    /// let text = "Scene(background: 1, camera: Camera(shutter: 0.5), \
    ///     objects: [Sphere(center: (\"=24*time\", 0, 0), radius: 1)])";
    /// let scene = load_str("s.ron", text, Syntax::Ron, Path::new(""), &[])?.scene;
    /// let later = scene.at(0.25).expect("it is right then, too");
    /// let Object::Sphere(sphere) = &later.objects[0].value else { panic!("it is a sphere") };
    /// assert_eq!(sphere.center.value, [0.25, 0.0, 0.0]);
    /// # Ok::<(), scene_format::LoadError>(())
    /// ```
    ///
    /// # Errors
    /// What is wrong with it then.
    pub fn at(&self, share: f64) -> Result<SceneDesc, Diagnostics> {
        let Some(read) = self.moments.0.as_deref().filter(|_| self.moves()) else { return Ok(self.clone()) };
        let mut now = read.texts.scene(share).map_err(|faults| self.told(faults, share))?;
        (now.animation, now.image, now.render) = (self.animation.clone(), self.image.clone(), self.render.clone());
        (now.output, now.cameras, now.camera_name) =
            (self.output.clone(), self.cameras.clone(), self.camera_name.clone());
        (now.effects.exposure, now.effects.tone_map) = (self.effects.exposure.clone(), self.effects.tone_map);
        if self.camera != read.camera {
            now.camera = self.camera.clone();
        }
        Ok(now)
    }

    /// Faults with the moment at which they are.
    fn told(&self, mut diagnostics: Diagnostics, share: f64) -> Diagnostics {
        let Animation { frame, .. } = &self.animation;
        // Not more digits than say something.
        let at = ((f64::from(frame.value) + share) * 1e6).round() / 1e6;
        for fault in &mut diagnostics {
            fault.message += &format!(" (at frame {at}, while the shutter is open)");
            // What mends it then may be wrong at the beginning.
            fault.edit = None;
        }
        diagnostics
    }
}
