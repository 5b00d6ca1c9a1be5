//! The methods by which a view can be made: the cut surface, and the reformations that it is compared with.

use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::frame::Frame;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::reformations::cr::{CrParameters, cr};
use lumencut_core::reformations::mpcpr::mpcpr;
use lumencut_core::scene::Scene;
use lumencut_core::settings::Settings;
use lumencut_gpu::renderer::GpuRenderer;

/// Refuses a focus and chosen vessels in pictures by another method than the cut surface, which has a place for neither.
///
/// # Errors
/// [`ErrorKind::Settings`] for settings that have one.
pub fn refuse_focus(settings: &Settings) -> Result<()> {
    let Some((setting, what)) = settings.focused() else { return Ok(()) };
    let found = format!("{what} for a picture that is not a cut surface");
    Err(Error::new(ErrorKind::Settings, setting, found, "none: CPR, mpCPR and CR show their whole surface")
        .mend(format!("leave the {setting} out")))
}

/// How the places where the pixels look are found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// Curved Surface Reformation, by the rules of the settings.
    CutSurface,
    /// Multipath CPR.
    MpCpr,
    /// Centerline Reformation.
    Cr(CrParameters),
}

impl Method {
    /// A view on the CPU.
    ///
    /// # Errors
    /// Those of the method and of what is shown.
    pub fn on_cpu(self, cpu: &mut CpuRenderer, scene: &Scene, request: &Request) -> Result<Frame> {
        let Some(frame) = self.places(scene, request)? else { return cpu.render(scene, request) };
        match &scene.volume {
            Some(volume) => cpu.look(volume, frame, request),
            None => Ok(frame.keeping(request.images)),
        }
    }

    /// A view of which a GPU shows the volume.
    ///
    /// # Errors
    /// As [`Method::on_cpu`], and [`ErrorKind::Device`] where the GPU has no room or fails.
    pub(crate) async fn on_gpu(
        self,
        gpu: &mut GpuRenderer,
        scene: &Scene<'_>,
        request: &Request<'_>,
    ) -> Result<Frame> {
        let Some(frame) = self.places(scene, request)? else { return gpu.render(scene, request).await };
        match &scene.volume {
            Some(volume) => gpu.look(volume, frame, request).await,
            None => Ok(frame.keeping(request.images)),
        }
    }

    /// Where the pixels look by a reformation.
    fn places(self, scene: &Scene, request: &Request) -> Result<Option<Frame>> {
        if self == Self::CutSurface {
            return Ok(None);
        }
        let Some(tree) = &scene.tree else {
            let expected = "a vessel tree to lay the image through";
            return Err(Error::new(ErrorKind::VesselTree, "tree of the scene", "none", expected));
        };
        refuse_focus(request.settings)?;
        let request = &request.without_unseen_picture(scene);
        match self {
            Self::CutSurface => Ok(None),
            Self::MpCpr => mpcpr(tree, request).map(Some),
            Self::Cr(parameters) => cr(tree, &parameters, request).map(Some),
        }
    }
}
