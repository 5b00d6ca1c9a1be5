//! Notes for the user about lines that were traced in a mask.

use lumencut_core::volume::Volume;
use lumencut_vessels::trace::mask::TracedMask;

use crate::text::rounded;

/// The notes, one sentence each; `has_volume` says whether a volume refined the lines.
pub fn notes(traced: &TracedMask, mask: &Volume, has_volume: bool) -> Vec<String> {
    let mut notes = Vec::new();
    let [cavities, voxels] = traced.filled;
    if cavities > 0 {
        let holes = if cavities == 1 { "1 cavity".to_owned() } else { format!("{cavities} cavities") };
        notes.push(format!("{holes} of {} filled", counted(voxels, "voxel")));
    }
    let followed = traced.gaps.len() + 1;
    if traced.pieces > followed {
        let left_out = counted(traced.pieces - followed, "piece");
        notes.push(format!("{left_out} of the mask left out: not longer than wide"));
    }
    let unseen = traced.vessels.iter().filter(|vessel| vessel.confidence.is_empty()).count();
    if unseen > 0 {
        let is_all = unseen == traced.vessels.len();
        let some = if is_all { String::new() } else { format!(" of {}", counted(unseen, "vessel")) };
        let why =
            if has_volume { "the volume gives no better estimate there" } else { "no grey values were used" };
        let axes = mask.world_from_index().matrix3;
        let side =
            [axes.x_axis, axes.y_axis, axes.z_axis].map(|axis| axis.length()).into_iter().fold(0.0, f64::max);
        let half = rounded(side / 2.0, 2);
        notes.push(format!(
            "the centre and radius{some} are accurate to about half a voxel ({half} mm): {why}"
        ));
    }
    notes
}

fn counted(count: usize, what: &str) -> String {
    if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") }
}
