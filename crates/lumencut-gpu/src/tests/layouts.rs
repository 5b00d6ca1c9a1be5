//! Structures have the layout that shaders expect: every field has the same name, offset and size in Rust and
//! in WGSL.

use std::collections::BTreeSet;

use bytemuck::Zeroable;
use lumencut_core::math::context_parameters::{ContextParameters, RiseParameters};
use lumencut_core::math::levels::{CutSurfaceParameters, LevelLayout};
use lumencut_core::math::tube::TubeRow;
use lumencut_core::reformations::endoscopy::wall::WallParameters;
use lumencut_core::shaders::SHADERS;
use lumencut_core::stages::body::BodyParameters;
use lumencut_core::stages::composite::CompositeParameters;
use lumencut_core::stages::depth_filter::DepthFilterParameters;
use lumencut_core::stages::far_rim::FarRimParameters;
use lumencut_core::stages::focus::FocusParameters;
use lumencut_core::stages::leap::LeapParameters;
use lumencut_core::stages::occlusion::{Blur, OcclusionParameters};
use lumencut_core::stages::rim::{RimParameters, RimStrip};
use lumencut_core::stages::silhouette::SilhouetteParameters;
use lumencut_core::stages::steady::SteadyParameters;
use lumencut_core::stages::surface::SurfaceParameters;
use naga::{AddressSpace, Handle, Module, Type, TypeInner};

use crate::levels::{Along, NodeBox, Point, Projected, Slot, Span};
use crate::stage::assemble;
use crate::surface::CurvedPixel;
use crate::view::{Axis, ViewParameters};
use crate::volume::GridParameters;
use crate::wall::WallRay;

type Field = (String, u32, u32);

#[derive(Clone, Debug, PartialEq)]
struct Layout {
    fields: Vec<Field>,
    span: u32,
}

/// Module, name and layout of a Rust structure; every field must be listed.
macro_rules! host {
    ($room:literal, $name:ident { $($field:ident),+ $(,)? }) => {{
        let $name { $($field),+ } = $name::zeroed();
        let fields = vec![$((
            stringify!($field).to_owned(),
            std::mem::offset_of!($name, $field) as u32,
            size_of_val(&$field) as u32,
        )),+];
        ($room, stringify!($name), Layout { fields, span: size_of::<$name>() as u32 })
    }};
}

fn hosts() -> Vec<(&'static str, &'static str, Layout)> {
    vec![
        host!("math/tube", TubeRow { middle, tangent, across }),
        host!("math/tube", WallParameters { eye, origin, x, y, z, size, rows, near }),
        host!(
            "reformations/endoscopy/wall",
            WallRay { direction, start, end, padding_0, padding_1, padding_2 }
        ),
        host!("math/hierarchy", NodeBox { low, high, z, radius, tiers, padding }),
        host!(
            "math/levels",
            CutSurfaceParameters {
                weight,
                margin,
                lift,
                distance_slack,
                depth_slack,
                selection,
                coarsest,
                radius_scale,
                unknown_radius,
                vessel_count,
                padding,
                origin_coarse,
                origin_fine,
                levels
            }
        ),
        host!("math/levels", LevelLayout { first_slot, first_bundle, bundle_count, height_count, heights }),
        host!(
            "math/pieces",
            Slot {
                start,
                next,
                edge,
                before,
                inverse_length,
                stripe_z,
                stripe_dz,
                wedge_z,
                radius,
                radius_change,
                slot,
                tiers
            }
        ),
        host!("math/projection", Point { coarse, radius, fine, place }),
        host!("math/projection", Along { next, arc_length, vessel }),
        host!(
            "math/levels",
            Projected { point, radius, edge, before, inverse_length, arc_length, stands, vessel }
        ),
        host!("math/levels", Span { first, end, level, first_chosen, end_chosen }),
        host!(
            "stages/focus",
            FocusParameters { margin, per_fade, near, far, others, halo, wall, shade, halo_end, halo_rest }
        ),
        host!("stages/body", BodyParameters { size, first, per_pixel, per_line, padding }),
        host!("stages/occlusion", OcclusionParameters { blurs }),
        host!("stages/occlusion", Blur { weights, side, reach, padding }),
        host!("stages/far_rim", FarRimParameters { width, strength }),
        host!("stages/steady", SteadyParameters { limit, slope }),
        host!("stages/leap", LeapParameters { pixel_spacing }),
        host!("stages/rim", RimParameters { near, far, per_side, most }),
        host!("stages/rim", RimStrip { first, last, per_mm }),
        host!(
            "math/sampling",
            GridParameters {
                last,
                shift,
                low,
                depth,
                unit,
                per_unit,
                padding,
                origin,
                origin_rest,
                x,
                x_rest,
                y,
                y_rest,
                z,
                z_rest,
                per_voxel,
                right,
                up
            }
        ),
        host!("math/view", ViewParameters { size, spacing, axes }),
        host!("math/view", Axis { coarse, fine }),
        host!(
            "math/context_parameters",
            ContextParameters {
                window,
                opacity,
                per_step,
                behind,
                push,
                mix,
                most,
                black,
                noise,
                last,
                first_color,
                first_opacity,
                rise_count,
                gap_count,
                level_count,
                finest,
                rises,
                gaps,
                levels
            }
        ),
        host!("math/context_parameters", RiseParameters { color, opacity, start, per_intensity, padding }),
        host!("stages/composite", CompositeParameters { background, line, context, grey, opacity }),
        host!("stages/depth_filter", DepthFilterParameters { weights, leap, padding, more_padding }),
        host!("stages/silhouette", SilhouetteParameters { per_slope, half, line_width }),
        host!("stages/surface", CurvedPixel { whole, part, per_mm }),
        host!("stages/surface", SurfaceParameters { half, mode, per_step, padding }),
    ]
}

fn shader_layout(text: &str, name: &str) -> Option<Layout> {
    let module = naga::front::wgsl::parse_str(text).unwrap_or_else(|e| panic!("{}", e.emit_to_string(text)));
    module.types.iter().find_map(|(_, ty)| match &ty.inner {
        TypeInner::Struct { members, span } if ty.name.as_deref() == Some(name) => {
            let size = |ty: Handle<Type>| module.types[ty].inner.size(module.to_ctx());
            let field = |m: &naga::StructMember| (m.name.clone().unwrap_or_default(), m.offset, size(m.ty));
            Some(Layout { fields: members.iter().map(field).collect(), span: *span })
        }
        _ => None,
    })
}

/// The names of the structures in buffers, including those of array elements and fields.
fn in_buffers(module: &Module) -> BTreeSet<String> {
    fn collect(module: &Module, ty: Handle<Type>, names: &mut BTreeSet<String>) {
        match &module.types[ty].inner {
            TypeInner::Array { base, .. } => collect(module, *base, names),
            TypeInner::Struct { members, .. } => {
                names.extend(module.types[ty].name.clone());
                members.iter().for_each(|member| collect(module, member.ty, names));
            }
            _ => {}
        }
    }
    let mut names = BTreeSet::new();
    for (_, global) in module.global_variables.iter() {
        if matches!(global.space, AddressSpace::Uniform | AddressSpace::Storage { .. }) {
            collect(module, global.ty, &mut names);
        }
    }
    names
}

#[test]
fn host_structures_lie_as_shaders_read_them() {
    for (room, name, host) in hosts() {
        assert_eq!(shader_layout(&assemble(room), name), Some(host), "{name} of {room}");
    }
}

#[test]
fn every_structure_in_a_buffer_is_compared() {
    let mut compared: BTreeSet<String> = hosts().iter().map(|(_, name, _)| (*name).to_owned()).collect();
    // The host allocates the squares of a preview, but never reads them.
    compared.insert("Square".to_owned());
    for shader in SHADERS {
        let module = naga::front::wgsl::parse_str(&assemble(shader.room)).unwrap();
        let missing: Vec<_> = in_buffers(&module).difference(&compared).cloned().collect();
        assert!(missing.is_empty(), "{}: add a line to `hosts` for {missing:?}", shader.room);
    }
}

#[test]
fn the_comparison_sees_every_difference() {
    let (_, _, host) = host!("stages/silhouette", SilhouetteParameters { per_slope, half, line_width });
    let same = |fields: &str| {
        shader_layout(&format!("struct SilhouetteParameters {{ {fields} }}"), "SilhouetteParameters").as_ref()
            == Some(&host)
    };
    assert!(same("per_slope: f32, half: f32, line_width: f32"));
    assert!(!same("steep: f32, half: f32, line_width: f32"), "renamed");
    assert!(!same("half: f32, per_slope: f32, line_width: f32"), "swapped");
    assert!(!same("per_slope: vec2f, half: f32, line_width: f32"), "widened");
    assert!(!same("per_slope: f32, half: f32, line_width: vec2f"), "widened at the end");
    assert!(!same("per_slope: f32, half: f32, @align(16) line_width: f32"), "moved");
    assert!(!same("per_slope: f32, half: f32"), "missing");
    assert!(!same("per_slope: f32, half: f32, line_width: f32, more: u32"), "more");
    assert_eq!(shader_layout("struct Other { size: vec2u }", "SilhouetteParameters"), None);
}
