//! Splits vessels of a label map where the label changes.

use crate::trace::skeleton::label_value::label_at;
use crate::trace::skeleton::mask_vessels::MaskVessel;
use lumencut_core::math::arc_length::arc_lengths;
use lumencut_core::volume::Volume;

/// Minimum length (radii) of a part with its own label.
const SHORTEST: f64 = 2.0;

#[derive(Clone, Copy)]
struct LabelRun {
    from: usize,
    to: usize,
    label: i64,
}

/// Splits a vessel into parts that each have one label; consecutive parts share a point.
pub(crate) fn parted(vessel: &MaskVessel, mask: &Volume, labels: Option<&[i64]>) -> Vec<MaskVessel> {
    let ways = arc_lengths(&vessel.points);
    let mut runs = runs(vessel, mask, labels);
    let shortest = SHORTEST * vessel.mean_radius();
    let length = |run: &LabelRun| ways[run.to] - ways[run.from];
    while runs.len() > 1 {
        let least = (0..runs.len()).min_by(|&a, &b| length(&runs[a]).total_cmp(&length(&runs[b])));
        let Some(least) = least.filter(|&n| length(&runs[n]) < shortest) else { break };
        let next = [least.checked_sub(1), Some(least + 1)].into_iter().flatten().filter(|&n| n < runs.len());
        let Some(next) = next.max_by(|&a, &b| length(&runs[a]).total_cmp(&length(&runs[b]))) else {
            break;
        };
        runs[next].from = runs[next].from.min(runs[least].from);
        runs[next].to = runs[next].to.max(runs[least].to);
        runs.remove(least);
        runs.dedup_by(|after, before| {
            let same = after.label == before.label;
            if same {
                before.to = after.to;
            }
            same
        });
    }
    let last = runs.len() - 1;
    let part = |(n, run): (usize, LabelRun)| MaskVessel {
        points: vessel.points[run.from..=run.to].to_vec(),
        radius: vessel.radius[run.from..=run.to].to_vec(),
        confidence: vessel.confidence.get(run.from..=run.to).unwrap_or_default().to_vec(),
        is_free: [n == 0 && vessel.is_free[0], n == last && vessel.is_free[1]],
        label: run.label,
        ..vessel.clone()
    };
    runs.into_iter().enumerate().map(part).collect()
}

/// Parts of one label each; neighbouring parts share end points. Points outside the lumen take the previous label.
fn runs(vessel: &MaskVessel, mask: &Volume, labels: Option<&[i64]>) -> Vec<LabelRun> {
    let is_lumen = |label: &i64| *label != 0 && labels.is_none_or(|labels| labels.contains(label));
    let at = |n: usize| {
        let index = mask.index_from_world().transform_point3(vessel.points[n]).round();
        let inside = std::array::from_fn(|a| index[a].clamp(0.0, (mask.size()[a] - 1) as f64) as usize);
        Some(label_at(mask, inside)).filter(is_lumen)
    };
    let known: Vec<Option<i64>> = (0..vessel.points.len()).map(at).collect();
    let mut label = known.iter().flatten().next().copied().unwrap_or(0);
    let mut runs = vec![LabelRun { from: 0, to: 0, label }];
    for (n, found) in known.into_iter().enumerate().skip(1) {
        let before = label;
        label = found.unwrap_or(before);
        if label == before || n == vessel.points.len() - 1 {
            label = before;
            let last = runs.len() - 1;
            runs[last].to = n;
        } else {
            let last = runs.len() - 1;
            runs[last].to = n;
            runs.push(LabelRun { from: n, to: n, label });
        }
    }
    runs
}
