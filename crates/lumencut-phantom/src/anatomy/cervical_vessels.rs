//! Vessels from the aortic arch to the circle of Willis; z = 0 at the top of the arch.

use super::{Branch, SIDES, on_side};
use crate::curve::WayPoint;
use crate::network::{Network, TrunkId, Vasculature};

/// The aorta from above its valve over the arch to the level of T6.
const ARCH: [WayPoint; 8] = [
    [-18.0, -30.0, -70.0, 15.5],
    [-15.0, -35.0, -42.0, 15.2],
    [-3.0, -31.0, -14.0, 14.6],
    [11.0, -14.0, -3.0, 14.0],
    [20.0, 8.0, -9.0, 13.2],
    [24.0, 27.0, -29.0, 12.5],
    [24.0, 35.0, -50.0, 12.2],
    [23.0, 37.0, -72.0, 12.0],
];

/// The left common carotid artery; the right one is its mirror image.
const CAROTID: [WayPoint; 2] = [[31.0, -13.0, 98.0, 3.5], [33.0, -8.0, 138.0, 3.9]];

const INTERNAL_CAROTID: [WayPoint; 10] = [
    [33.0, -8.0, 138.0, 3.7],
    [38.0, -3.0, 150.0, 3.9],
    [39.0, 1.0, 168.0, 2.7],
    [36.0, 1.0, 192.0, 2.5],
    [32.0, -1.0, 205.0, 2.5],
    [22.0, -11.0, 212.0, 2.4],
    [15.0, -20.0, 215.0, 2.4],
    [13.0, -29.0, 220.0, 2.3],
    [13.5, -31.0, 226.0, 2.2],
    [13.0, -22.0, 232.0, 2.1],
];

const EXTERNAL_CAROTID: [WayPoint; 6] = [
    [33.0, -8.0, 138.0, 2.7],
    [33.0, -16.0, 152.0, 2.6],
    [41.0, -16.0, 176.0, 2.3],
    [50.0, -8.0, 202.0, 2.0],
    [70.0, 0.0, 222.0, 1.5],
    [75.0, -8.0, 256.0, 1.1],
];

const EXTERNAL_CAROTID_BRANCHES: [Branch<4>; 5] = [
    (
        "superior thyroid artery",
        [
            [33.0, -13.0, 145.0, 1.4],
            [28.0, -24.0, 140.0, 1.3],
            [22.0, -28.0, 118.0, 1.2],
            [20.0, -26.0, 98.0, 0.9],
        ],
    ),
    (
        "lingual artery",
        [
            [34.0, -16.0, 154.0, 1.5],
            [28.0, -30.0, 152.0, 1.4],
            [18.0, -48.0, 156.0, 1.2],
            [10.0, -66.0, 168.0, 0.9],
        ],
    ),
    (
        "facial artery",
        [
            [37.0, -16.0, 164.0, 1.6],
            [46.0, -36.0, 154.0, 1.5],
            [49.0, -54.0, 166.0, 1.3],
            [34.0, -78.0, 192.0, 0.9],
        ],
    ),
    (
        "occipital artery",
        [
            [39.0, -16.0, 170.0, 1.5],
            [52.0, 14.0, 182.0, 1.4],
            [54.0, 60.0, 196.0, 1.2],
            [39.0, 88.0, 224.0, 0.9],
        ],
    ),
    (
        "maxillary artery",
        [
            [51.0, -8.0, 203.0, 1.6],
            [45.0, -22.0, 198.0, 1.4],
            [42.0, -40.0, 196.0, 1.2],
            [40.0, -46.0, 188.0, 0.9],
        ],
    ),
];

/// The left vertebral artery: from the subclavian artery through the transverse processes, around the atlas to the basilar artery.
const VERTEBRAL: [WayPoint; 10] = [
    [42.0, -16.0, 49.0, 2.3],
    [33.0, 4.0, 66.0, 2.0],
    [24.0, 23.0, 86.0, 1.9],
    [24.0, 23.0, 120.0, 1.9],
    [24.0, 22.0, 160.0, 1.9],
    [28.0, 22.0, 180.0, 1.9],
    [33.0, 24.0, 190.0, 1.9],
    [24.0, 36.0, 196.0, 1.8],
    [12.0, 32.0, 200.0, 1.7],
    [0.0, 19.0, 205.0, 1.6],
];

const SUBCLAVIAN_BRANCHES: [Branch<3>; 2] = [
    ("thyrocervical trunk", [[50.0, -14.0, 51.0, 1.8], [44.0, -16.0, 66.0, 1.6], [26.0, -12.0, 84.0, 1.1]]),
    (
        "internal thoracic artery",
        [[48.0, -15.0, 50.0, 1.6], [32.0, -56.0, 10.0, 1.5], [26.0, -84.0, -68.0, 1.2]],
    ),
];

pub(super) fn draw(seed: u64, segments: usize) -> Vasculature {
    let mut network = Network::new(seed);
    let arch = network.trunk("aortic arch", &ARCH, 0.8);
    network.scatter_calcium(arch, 6, [0.3, 0.9]);
    let way = [[0.0, 19.0, 205.0, 2.0], [0.5, 14.0, 220.0, 1.9], [0.0, 7.0, 238.0, 1.8]];
    let basilar = network.trunk("basilar artery", &way, 0.6);
    right_side(&mut network, arch, basilar);
    left_side(&mut network, arch, basilar);
    posterior_cerebrals(&mut network, basilar);
    network.finish(segments)
}

fn right_side(network: &mut Network, arch: TrunkId, basilar: TrunkId) {
    let (side, name) = SIDES[0];
    let way = [[-2.0, -30.0, -12.0, 6.8], [-12.0, -31.0, 8.0, 6.5], [-24.0, -27.0, 34.0, 6.2]];
    let trunk = network.branch(arch, "brachiocephalic trunk", &way, 1.0);
    let mut way = vec![[-24.0, -27.0, 34.0, 3.8], [-27.0, -22.0, 56.0, 3.6]];
    way.extend(on_side(side, CAROTID));
    let carotid = network.branch(trunk, &format!("{name} common carotid artery"), &way, 1.8);
    head_arteries(network, carotid, side, name);
    let start = [[-24.0, -27.0, 34.0, 4.6], [-36.0, -20.0, 47.0, 4.5]];
    arm_arteries(network, [trunk, basilar], &start, side, name);
}

fn left_side(network: &mut Network, arch: TrunkId, basilar: TrunkId) {
    let (side, name) = SIDES[1];
    let mut way = vec![[6.0, -20.0, -6.0, 4.2], [10.0, -26.0, 22.0, 3.8], [24.0, -21.0, 58.0, 3.6]];
    way.extend(CAROTID);
    let carotid = network.branch(arch, &format!("{name} common carotid artery"), &way, 1.8);
    head_arteries(network, carotid, side, name);
    let start = [[16.0, -3.0, -5.0, 5.2], [23.0, -4.0, 18.0, 4.8], [34.0, -12.0, 42.0, 4.6]];
    arm_arteries(network, [arch, basilar], &start, side, name);
}

fn head_arteries(network: &mut Network, common: TrunkId, side: f64, name: &str) {
    network.scatter_calcium(common, 2, [0.86, 0.97]);
    let way = on_side(side, INTERNAL_CAROTID);
    let internal = network.branch(common, &format!("{name} internal carotid artery"), &way, 0.7);
    network.stenosis(internal, 0.11, 13.0, if side < 0.0 { 70.0 } else { 45.0 });
    network.scatter_calcium(internal, 2, [0.03, 0.2]);
    cerebral_arteries(network, internal, side, name);
    let way = on_side(side, EXTERNAL_CAROTID);
    let external = network.branch(common, &format!("{name} external carotid artery"), &way, 0.8);
    for (part, way) in EXTERNAL_CAROTID_BRANCHES {
        network.branch(external, &format!("{name} {part}"), &on_side(side, way), 0.8);
    }
}

fn cerebral_arteries(network: &mut Network, internal: TrunkId, side: f64, name: &str) {
    let way = on_side(
        side,
        [
            [13.0, -22.0, 232.0, 1.6],
            [26.0, -22.0, 233.0, 1.5],
            [42.0, -20.0, 237.0, 1.3],
            [50.0, -8.0, 250.0, 1.1],
            [56.0, 6.0, 266.0, 0.9],
        ],
    );
    let middle = network.branch(internal, &format!("{name} middle cerebral artery"), &way, 0.8);
    let way =
        on_side(side, [[43.0, -20.0, 238.0, 1.2], [50.0, -26.0, 252.0, 1.0], [56.0, -24.0, 272.0, 0.8]]);
    network.branch(middle, &format!("{name} middle cerebral artery, superior trunk"), &way, 0.8);
    let way = on_side(
        side,
        [
            [13.0, -22.0, 232.0, 1.3],
            [4.5, -29.0, 235.0, 1.2],
            [2.5, -42.0, 250.0, 1.1],
            [2.5, -40.0, 274.0, 0.9],
            [2.5, -8.0, 290.0, 0.8],
        ],
    );
    network.branch(internal, &format!("{name} anterior cerebral artery"), &way, 0.5);
}

/// Draws the subclavian artery of one side and its branches; the vertebral artery ends where the basilar artery starts.
fn arm_arteries(
    network: &mut Network,
    [parent, basilar]: [TrunkId; 2],
    start: &[WayPoint],
    side: f64,
    name: &str,
) {
    let mut way = start.to_vec();
    way.extend(on_side(
        side,
        [
            [56.0, -13.0, 52.0, 4.4],
            [86.0, -14.0, 42.0, 4.2],
            [124.0, -16.0, 24.0, 4.0],
            [166.0, -10.0, 4.0, 3.7],
        ],
    ));
    let subclavian = network.branch(parent, &format!("{name} subclavian artery"), &way, 1.0);
    let way = on_side(side, VERTEBRAL);
    let vertebral = network.bridge(subclavian, basilar, &format!("{name} vertebral artery"), &way, 0.3);
    network.stenosis(vertebral, 0.06, 12.0, 50.0);
    for (part, way) in SUBCLAVIAN_BRANCHES {
        network.branch(subclavian, &format!("{name} {part}"), &on_side(side, way), 0.8);
    }
}

fn posterior_cerebrals(network: &mut Network, basilar: TrunkId) {
    for (side, name) in SIDES {
        let way = on_side(
            side,
            [
                [0.0, 7.0, 238.0, 1.4],
                [12.0, 6.0, 241.0, 1.3],
                [24.0, 24.0, 246.0, 1.1],
                [20.0, 62.0, 254.0, 0.9],
            ],
        );
        network.branch(basilar, &format!("{name} posterior cerebral artery"), &way, 0.5);
        let way = on_side(side, [[0.0, 8.5, 234.0, 1.1], [16.0, 14.0, 230.0, 1.0], [28.0, 40.0, 228.0, 0.9]]);
        network.branch(basilar, &format!("{name} superior cerebellar artery"), &way, 0.4);
    }
}
