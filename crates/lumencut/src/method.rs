//! The methods of a view: the cut surface, and the reformations that it is compared with.

use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::frame::Frame;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::reformations::cr::{CrParameters, cr};
use lumencut_core::reformations::mpcpr::mpcpr;
use lumencut_core::scene::Scene;
use lumencut_core::settings::Settings;
use lumencut_gpu::renderer::GpuRenderer;

/// Rejects settings with a focus or selected vessels, which only the cut surface supports. Fails with
/// [`ErrorKind::Settings`] if the settings contain one of them.
pub fn refuse_focus(settings: &Settings) -> Result<()> {
    let Some((setting, what)) = settings.focused() else { return Ok(()) };
    let found = format!("{what} for a picture that is not a cut surface");
    Err(Error::new(ErrorKind::Settings, setting, found, "none: CPR, mpCPR and CR show their whole surface")
        .mend(format!("leave the {setting} out")))
}

/// The methods by which the sampled positions of a view are computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// Curved Surface Reformation, with the settings.
    CutSurface,
    /// Multipath CPR.
    MpCpr,
    /// Centerline Reformation.
    Cr(CrParameters),
}

impl Method {
    /// Renders a view by this method on the CPU.
    pub fn on_cpu(self, cpu: &mut CpuRenderer, scene: &Scene, request: &Request) -> Result<Frame> {
        let Some(frame) = self.places(scene, request)? else { return cpu.render(scene, request) };
        match &scene.volume {
            Some(volume) => cpu.look(volume, frame, request),
            None => Ok(frame.keeping(request.images)),
        }
    }

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
