//! The table of the stages: their names, the images that they read and write, and when they run. Timings,
//! fallbacks, tests and benches use it.

use crate::error::{Error, ErrorKind, Result};
use crate::geometry::Geometry;
use crate::settings::{LevelChoice, Settings, SilhouetteRule};

/// An image of a view: one number or one vector for each pixel, in rows from the top.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Image {
    /// Distance to the nearest centerline in the image plane (mm), f32.
    Distance,
    /// Depth of the cut surface before the depth filter (mm), f32.
    UnfilteredDepth,
    /// Depth of the cut surface (mm), f32.
    Depth,
    /// Id of the vessel that a pixel belongs to, i32.
    Vessel,
    /// Slopes, radius and gap of the cut surface before the depth filter, four f32 (`stages::depth::Sheet`).
    Sheet,
    /// Cost, level and kind of piece before the depth filter, four f32 (`stages::depth::Blend`). A view that shows the
    /// volume has none.
    Blend,
    /// Arc length (mm) and distance beyond the wall (mm) of the piece shown, four f32 (`stages::depth::Foot`).
    Foot,
    /// Depth of the cut surface in the view before (mm), f32; only in a turn (`stages::steady`).
    Before,
    /// Bits that mark jumps of the cut surface's depth, u32 (`stages::leap`).
    Leap,
    /// Shares of the cut surface and its silhouettes that are shown, and factors on colours, 0 to 1, four f32 (`stages::focus`).
    Focus,
    /// The rim around the vessels: its colour and its share, four bytes (`stages::rim`).
    Rim,
    /// The volume at the cut surface, f32; NaN outside the volume (on a GPU 3·10³⁸).
    Value,
    /// Strength of the silhouettes, 0 to 1, f32.
    Strength,
    /// Depth at which the ray of the context starts (mm), f32.
    Start,
    /// The context: premultiplied colours and opacity, four f32.
    Gathered,
    /// Only the context, as RGBA with straight alpha, four bytes.
    Context,
    /// The picture as RGBA with straight alpha, four bytes.
    Picture,
}

impl Image {
    /// Every image.
    pub const ALL: [Self; 17] = [
        Self::Distance,
        Self::UnfilteredDepth,
        Self::Depth,
        Self::Vessel,
        Self::Sheet,
        Self::Blend,
        Self::Foot,
        Self::Before,
        Self::Leap,
        Self::Focus,
        Self::Rim,
        Self::Value,
        Self::Strength,
        Self::Start,
        Self::Gathered,
        Self::Context,
        Self::Picture,
    ];
}

impl Image {
    /// The images of a frame, by their names.
    const OF_FRAME: [(&'static str, Self); 9] = [
        ("image", Self::Picture),
        ("depth", Self::Depth),
        ("vessel", Self::Vessel),
        ("distance", Self::Distance),
        ("value", Self::Value),
        ("context", Self::Context),
        ("cost", Self::Blend),
        ("level", Self::Blend),
        ("piece", Self::Blend),
    ];

    /// The image that a frame has under this name. Fails with [`ErrorKind::Settings`] for another name.
    pub fn of_frame(name: &str) -> Result<Self> {
        let known = Self::OF_FRAME.iter().find(|(known, _)| *known == name);
        known.map(|(_, image)| *image).ok_or_else(|| {
            let names: Vec<_> = Self::OF_FRAME.iter().map(|(known, _)| *known).collect();
            Error::new(ErrorKind::Settings, "image of the frame", format!("'{name}'"), names.join(", "))
        })
    }
}

/// A set of images.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ImageSet(u32);

impl ImageSet {
    /// All images that a frame can have.
    pub const ALL: Self = Self::of(&[
        Image::Distance,
        Image::Depth,
        Image::Vessel,
        Image::Value,
        Image::Context,
        Image::Picture,
    ]);

    /// The set of these images.
    pub const fn of(images: &[Image]) -> Self {
        let (mut bits, mut n) = (0, 0);
        while n < images.len() {
            bits |= 1 << images[n] as u32;
            n += 1;
        }
        Self(bits)
    }

    /// The union with another set.
    #[must_use]
    pub const fn and(self, others: Self) -> Self {
        Self(self.0 | others.0)
    }

    /// The set without one image.
    #[must_use]
    pub const fn without(self, image: Image) -> Self {
        Self(self.0 & !(1 << image as u32))
    }

    /// Whether an image is in the set.
    pub const fn has(self, image: Image) -> bool {
        self.0 & 1 << image as u32 != 0
    }
}

/// The stages of a view. File, function, shader, timings and heading in docs/method have the same name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Levels of detail of the tree, computed once per tree.
    Levels,
    /// Projects the levels into the view.
    Projection,
    /// Distance to the nearest vessel.
    Distance,
    /// Depth and vessel of the cut surface.
    Depth,
    /// Marks neighbours between which the depth of the cut surface jumps.
    Leap,
    /// Smooths the depth with a Gaussian.
    DepthFilter,
    /// Holds the depth near that of the view before in a turn.
    Steady,
    /// Computes how much of the cut surface is shown around the vessels.
    Focus,
    /// Computes how much the cut surface is darkened where it lies deeper than its surroundings.
    Occlusion,
    /// Darkens the farther side of depth jumps whose lines have faded out.
    FarRim,
    /// Colours a rim around the vessels by values along them.
    Rim,
    /// Samples the volume at the cut surface.
    Surface,
    /// Draws lines where the depth of the cut surface jumps.
    Silhouette,
    /// Ranges of values of the volume, computed once per volume; on the CPU timed with the starts of rays.
    Blocks,
    /// Follows rays through the volume.
    Context,
    /// Puts the outline of the body behind the context.
    Body,
    /// Composes the picture from all layers.
    Composite,
}

impl Stage {
    /// Every stage, in the order in which they run.
    pub const ALL: [Self; 17] = [
        Self::Levels,
        Self::Projection,
        Self::Distance,
        Self::Depth,
        Self::Leap,
        Self::DepthFilter,
        Self::Steady,
        Self::Focus,
        Self::Occlusion,
        Self::FarRim,
        Self::Rim,
        Self::Surface,
        Self::Silhouette,
        Self::Blocks,
        Self::Context,
        Self::Body,
        Self::Composite,
    ];

    /// The name of the stage.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Levels => "levels",
            Self::Projection => "projection",
            Self::Distance => "distance",
            Self::Depth => "depth",
            Self::Steady => "steady",
            Self::Leap => "leap",
            Self::DepthFilter => "depth_filter",
            Self::Focus => "focus",
            Self::Occlusion => "occlusion",
            Self::FarRim => "far_rim",
            Self::Rim => "rim",
            Self::Surface => "surface",
            Self::Silhouette => "silhouette",
            Self::Blocks => "blocks",
            Self::Context => "context",
            Self::Body => "body",
            Self::Composite => "composite",
        }
    }

    /// Relative cost per pixel: about the milliseconds that 512 × 512 pixels take. Only `progress` uses it.
    pub const fn cost(self) -> usize {
        match self {
            Self::Levels | Self::Projection | Self::Blocks => 0,
            Self::Distance | Self::Occlusion => 8,
            Self::Depth => 12,
            Self::Leap | Self::Focus | Self::FarRim | Self::Surface => 4,
            Self::Steady | Self::DepthFilter | Self::Silhouette | Self::Body | Self::Rim => 2,
            Self::Context => 14,
            Self::Composite => 10,
        }
    }

    /// The images that the stage reads, if they exist.
    pub const fn reads(self) -> &'static [Image] {
        match self {
            Self::Levels | Self::Projection | Self::Distance | Self::Blocks => &[],
            Self::Focus => &[Image::Leap],
            Self::Rim => &[Image::Foot, Image::Vessel],
            Self::Depth => &[Image::Distance],
            Self::Steady => &[Image::UnfilteredDepth, Image::Depth, Image::Foot, Image::Before],
            Self::Leap => &[Image::UnfilteredDepth, Image::Vessel, Image::Sheet],
            Self::DepthFilter => &[Image::UnfilteredDepth, Image::Vessel],
            Self::Occlusion => &[Image::UnfilteredDepth, Image::Depth, Image::Focus],
            Self::FarRim => &[Image::UnfilteredDepth, Image::Depth, Image::Leap, Image::Focus],
            Self::Surface => &[Image::Depth],
            Self::Silhouette => &[Image::Depth, Image::Vessel, Image::Leap, Image::Value],
            Self::Context => &[Image::Depth, Image::Focus, Image::Value],
            Self::Body => &[Image::Start, Image::Gathered],
            Self::Composite => &[Image::Focus, Image::Rim, Image::Value, Image::Strength, Image::Gathered],
        }
    }

    /// The images that the stage writes, in order, if something needs them; none if it only prepares.
    pub const fn writes(self) -> &'static [Image] {
        match self {
            Self::Levels | Self::Projection | Self::Blocks => &[],
            Self::Distance => &[Image::Distance],
            Self::Depth => &[Image::UnfilteredDepth, Image::Vessel, Image::Sheet, Image::Blend, Image::Foot],
            Self::Steady => &[Image::Depth],
            Self::Leap => &[Image::Leap],
            Self::DepthFilter => &[Image::Depth],
            Self::Focus | Self::Occlusion | Self::FarRim => &[Image::Focus],
            Self::Rim => &[Image::Rim],
            Self::Surface => &[Image::Value],
            Self::Silhouette => &[Image::Strength],
            Self::Context => &[Image::Start, Image::Gathered],
            Self::Body => &[Image::Gathered],
            Self::Composite => &[Image::Context, Image::Picture],
        }
    }

    /// The stages, in order, that find the cut surface of a view with the images `wanted`.
    pub fn of_cut_surface(settings: &Settings, wanted: ImageSet) -> Vec<Self> {
        let own = settings.level_choice == LevelChoice::Own;
        let draws_leaps = settings.silhouettes && settings.silhouette_rule == SilhouetteRule::Leap;
        let has_leaps = wanted.has(Image::Leap) || (draws_leaps && wanted.has(Image::Picture));
        let draws = wanted.has(Image::Focus) || wanted.has(Image::Picture);
        let has_reach = settings.silhouettes && settings.silhouette_reach.is_some();
        let has_focus = settings.focus.is_some() && (draws || wanted.has(Image::Context));
        let stages = [
            (Self::Distance, !own || wanted.has(Image::Distance)),
            (Self::Depth, true),
            (Self::Leap, has_leaps),
            (Self::DepthFilter, settings.depth_filter),
            (Self::Steady, wanted.has(Image::Before)),
            (Self::Focus, has_focus || ((has_reach || settings.occlusion > 0.0) && draws)),
            (Self::Occlusion, settings.occlusion > 0.0 && draws),
            (Self::FarRim, settings.far_rim > 0.0 && draws_leaps && has_leaps && has_reach && draws),
            (Self::Rim, Self::has_rim(settings, wanted)),
        ];
        needed(&stages)
    }

    /// Whether the stage is one of those that find the cut surface.
    pub const fn is_of_cut_surface(self) -> bool {
        matches!(
            self,
            Self::Distance
                | Self::Depth
                | Self::Steady
                | Self::Leap
                | Self::DepthFilter
                | Self::Focus
                | Self::Occlusion
                | Self::FarRim
                | Self::Rim
        )
    }

    /// Whether the stage `depth` writes the sheet: if `leap` needs it, or if it is wanted.
    pub fn has_sheet(settings: &Settings, wanted: ImageSet) -> bool {
        wanted.has(Image::Sheet) || Self::of_cut_surface(settings, wanted).contains(&Self::Leap)
    }

    /// Whether the stage `depth` writes the blend. No view that shows the volume has it, so on the GPU it has the buffer of the
    /// context.
    pub const fn has_blend(wanted: ImageSet) -> bool {
        let shows_volume = wanted.has(Image::Picture) || wanted.has(Image::Context);
        wanted.has(Image::Blend) && !shows_volume
    }

    /// Whether the stage `depth` writes the foot, for a picture's rim or the stage `steady`. On the GPU it has the buffer of
    /// the context, which is made later.
    pub const fn has_foot(settings: &Settings, wanted: ImageSet) -> bool {
        wanted.has(Image::Before) || Self::has_rim(settings, wanted)
    }

    const fn has_rim(settings: &Settings, wanted: ImageSet) -> bool {
        settings.rim.is_some() && (wanted.has(Image::Picture) || wanted.has(Image::Rim))
    }

    /// The stages, in order, that show the volume at the positions of `geometry`; the frame shall have the
    /// images `wanted`. Of the existing images `made`, the surface needs a depth, and silhouettes also leaps
    /// or vessels. A curved geometry has neither silhouettes nor context.
    pub fn of_look(settings: &Settings, geometry: &Geometry, made: ImageSet, wanted: ImageSet) -> Vec<Self> {
        let has_camera = geometry.camera().is_some();
        let has_surface = !has_camera || made.has(Image::Depth);
        let drawn_from = match settings.silhouette_rule {
            SilhouetteRule::Leap => Image::Leap,
            SilhouetteRule::Gradient => Image::Vessel,
        };
        let has_picture = wanted.has(Image::Picture);
        let can_have_silhouettes = has_camera && has_surface && made.has(drawn_from);
        let has_silhouettes = has_picture && settings.silhouettes && can_have_silhouettes;
        let wants_context = has_picture || wanted.has(Image::Context);
        let has_context = wants_context && has_camera && settings.context.is_some();
        // The values decide where rays of a context start.
        let has_values = has_surface && (has_picture || has_context || wanted.has(Image::Value));
        let stages = [
            (Self::Surface, has_values),
            (Self::Silhouette, has_silhouettes),
            (Self::Blocks, has_context),
            (Self::Context, has_context),
            (Self::Body, has_context && settings.context.as_ref().is_some_and(|c| c.body && !c.preview)),
            (Self::Composite, has_picture || has_context),
        ];
        needed(&stages)
    }
}

fn needed(stages: &[(Stage, bool)]) -> Vec<Stage> {
    stages.iter().filter(|(_, is_needed)| *is_needed).map(|(stage, _)| *stage).collect()
}
