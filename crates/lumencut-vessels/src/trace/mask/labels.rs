//! The labels of a label map along a vessel, which part it where one label ends and another begins.

use crate::trace::skeleton::label_value::label_at;
use crate::trace::skeleton::mask_vessels::MaskVessel;
use lumencut_core::math::arc_length::arc_lengths;
use lumencut_core::volume::Volume;

/// A stretch with a label of its own is a vessel of its own where it is at least so many radii long.
const SHORTEST: f64 = 2.0;

/// Points `from` to `to`, both included, which have one label.
#[derive(Clone, Copy)]
struct Stretch {
    from: usize,
    to: usize,
    label: i64,
}

/// A vessel in parts of one label each; parts that follow each other share a point.
pub fn parted(vessel: &MaskVessel, mask: &Volume, labels: Option<&[i64]>) -> Vec<MaskVessel> {
    let ways = arc_lengths(&vessel.points);
    let mut stretches = stretches(vessel, mask, labels);
    let shortest = SHORTEST * vessel.mean_radius();
    let length = |stretch: &Stretch| ways[stretch.to] - ways[stretch.from];
    while stretches.len() > 1 {
        let least =
            (0..stretches.len()).min_by(|&a, &b| length(&stretches[a]).total_cmp(&length(&stretches[b])));
        let Some(least) = least.filter(|&n| length(&stretches[n]) < shortest) else { break };
        let next =
            [least.checked_sub(1), Some(least + 1)].into_iter().flatten().filter(|&n| n < stretches.len());
        let Some(next) = next.max_by(|&a, &b| length(&stretches[a]).total_cmp(&length(&stretches[b]))) else {
            break;
        };
        stretches[next].from = stretches[next].from.min(stretches[least].from);
        stretches[next].to = stretches[next].to.max(stretches[least].to);
        stretches.remove(least);
        stretches.dedup_by(|after, before| {
            let same = after.label == before.label;
            if same {
                before.to = after.to;
            }
            same
        });
    }
    let last = stretches.len() - 1;
    let part = |(n, stretch): (usize, Stretch)| MaskVessel {
        points: vessel.points[stretch.from..=stretch.to].to_vec(),
        radius: vessel.radius[stretch.from..=stretch.to].to_vec(),
        confidence: vessel.confidence.get(stretch.from..=stretch.to).unwrap_or_default().to_vec(),
        is_free: [n == 0 && vessel.is_free[0], n == last && vessel.is_free[1]],
        label: stretch.label,
        ..vessel.clone()
    };
    stretches.into_iter().enumerate().map(part).collect()
}

/// The stretches of one label along a vessel, at least one, each of which begins with the last point of the one before.
/// A point outside the lumen, as in a cavity that was filled, has the label of the point before.
fn stretches(vessel: &MaskVessel, mask: &Volume, labels: Option<&[i64]>) -> Vec<Stretch> {
    let is_lumen = |label: &i64| *label != 0 && labels.is_none_or(|labels| labels.contains(label));
    let at = |n: usize| {
        let index = mask.index_from_world().transform_point3(vessel.points[n]).round();
        let inside = std::array::from_fn(|a| index[a].clamp(0.0, (mask.size()[a] - 1) as f64) as usize);
        Some(label_at(mask, inside)).filter(is_lumen)
    };
    let known: Vec<Option<i64>> = (0..vessel.points.len()).map(at).collect();
    let mut label = known.iter().flatten().next().copied().unwrap_or(0);
    let mut stretches = vec![Stretch { from: 0, to: 0, label }];
    for (n, found) in known.into_iter().enumerate().skip(1) {
        let before = label;
        label = found.unwrap_or(before);
        if label == before || n == vessel.points.len() - 1 {
            label = before;
            let last = stretches.len() - 1;
            stretches[last].to = n;
        } else {
            let last = stretches.len() - 1;
            stretches[last].to = n;
            stretches.push(Stretch { from: n, to: n, label });
        }
    }
    stretches
}
