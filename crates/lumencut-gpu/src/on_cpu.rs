//! The stages as the CPU does them, with what the GPU made before: to find where a difference begins.

use lumencut_core::error::Result;
use lumencut_core::math::lanes::Isa;
use lumencut_core::math::ray::WHOLE;
use lumencut_core::settings::Context;
use lumencut_core::stages::View;
use lumencut_core::stages::composite::{Layers, composite, layer};
use lumencut_core::stages::context::{context, starts};
use lumencut_core::stages::depth::depth;
use lumencut_core::stages::depth_filter::depth_filter;
use lumencut_core::stages::distance::distance;
use lumencut_core::stages::silhouette::silhouette;
use lumencut_core::stages::surface::surface;
use lumencut_core::volume::Volume;
use web_time::Instant;

use crate::pass::{Pass, Tree, with_holes, without_holes};

impl<'a> Pass<'a> {
    fn on_view(&self) -> View<'a> {
        View { camera: self.camera, isa: Isa::widest(), stop: self.stop }
    }

    pub(crate) async fn distance_on_cpu(&mut self) -> Result<()> {
        let (view, start) = (self.on_view(), Instant::now());
        let mut distances = vec![0.0; self.images.pixels()];
        if let Some(Tree { core, .. }) = &mut self.tree {
            let cut_surface = core.project(self.camera, self.settings);
            distance(&view, cut_surface.finest(), &mut distances)?;
        }
        self.device.write(&self.images.distance, &distances);
        self.count("distance", start);
        Ok(())
    }

    pub(crate) async fn depth_on_cpu(&mut self) -> Result<()> {
        let distances = self.read(&self.images.distance).await?;
        let (view, start) = (self.on_view(), Instant::now());
        let (mut depths, mut vessels) = (vec![0.0; distances.len()], vec![0; distances.len()]);
        if let Some(Tree { core, .. }) = &mut self.tree {
            let cut_surface = core.project(self.camera, self.settings);
            depth(&view, &cut_surface, &distances, &mut depths, &mut vessels)?;
        }
        self.device.write(self.raw_depth(), &depths);
        self.device.write(&self.images.vessel, &vessels);
        self.count("depth", start);
        Ok(())
    }

    pub(crate) async fn depth_filter_on_cpu(&mut self) -> Result<()> {
        let depths = self.read(&self.images.unfiltered).await?;
        let start = Instant::now();
        let mut smoothed = vec![0.0; depths.len()];
        depth_filter(&self.on_view(), &depths, &mut smoothed)?;
        self.device.write(&self.images.depth, &smoothed);
        self.count("depth_filter", start);
        Ok(())
    }

    pub(crate) async fn surface_on_cpu(&mut self, volume: &Volume<'_>) -> Result<()> {
        let depths = self.read(&self.images.depth).await?;
        let start = Instant::now();
        let mut values = vec![0.0; depths.len()];
        surface(&self.on_view(), volume, &depths, self.settings.slab, &mut values)?;
        self.device.write(&self.images.value, &without_holes(values));
        self.count("surface", start);
        Ok(())
    }

    pub(crate) async fn silhouette_on_cpu(&mut self) -> Result<()> {
        let depths = self.read(&self.images.depth).await?;
        let vessels = self.read(&self.images.vessel).await?;
        let start = Instant::now();
        let mut strength = vec![0.0; depths.len()];
        silhouette(&self.on_view(), &depths, &vessels, self.settings.silhouette_slope, &mut strength)?;
        self.device.write(&self.images.strength, &strength);
        self.count("silhouette", start);
        Ok(())
    }

    pub(crate) async fn context_on_cpu(&mut self, volume: &Volume<'_>, settings: &Context) -> Result<()> {
        let pixels = self.images.pixels();
        let start = if self.has_value() {
            let values = with_holes(self.read(&self.images.value).await?);
            let depths: Vec<f32> = self.read(&self.images.depth).await?;
            starts(&values, &depths, self.settings)
        } else {
            vec![WHOLE; pixels]
        };
        let clock = Instant::now();
        let mut colors = vec![[0f32; 4]; pixels];
        context(&self.on_view(), volume, Some(volume.blocks(self.stop)?), settings, &start, &mut colors)?;
        self.device.write(&self.images.context, &colors);
        self.count("context", clock);
        Ok(())
    }

    pub(crate) async fn composite_on_cpu(&mut self) -> Result<()> {
        let pixels = self.images.pixels();
        let value = if self.has_value() {
            with_holes(self.read(&self.images.value).await?)
        } else {
            vec![f32::NAN; pixels]
        };
        let strength = if self.has_strength() { Some(self.read(&self.images.strength).await?) } else { None };
        let behind: Option<Vec<[f32; 4]>> =
            if self.has_context() { Some(self.read(&self.images.context).await?) } else { None };
        let start = Instant::now();
        let mut image = vec![[0u8; 4]; pixels];
        if let Some(behind) = &behind {
            layer(&self.on_view(), behind, &mut image)?;
            self.device.write(&self.images.layer, &image);
        }
        let layers = Layers { value: &value, strength: strength.as_deref(), context: behind.as_deref() };
        composite(&self.on_view(), &layers, self.settings, &mut image)?;
        self.device.write(&self.images.image, &image);
        self.count("composite", start);
        Ok(())
    }
}
