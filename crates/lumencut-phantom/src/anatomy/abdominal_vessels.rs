//! Abdominal aorta and branches to the iliac arteries; z = 0 at the aortic bifurcation.

use super::{Branch, SIDES, on_side};
use crate::curve::WayPoint;
use crate::network::{Network, TrunkId};

pub(super) struct AbdominalVessels {
    pub(super) external_iliac: [TrunkId; 2],
}

/// Draws the aorta from height `top` downwards. The external iliac arteries follow `external_iliac`: way points of the left side,
/// from the end of the common iliac artery on.
pub(super) fn draw(network: &mut Network, top: f64, external_iliac: &[WayPoint]) -> AbdominalVessels {
    let way: Vec<WayPoint> = [
        [2.0, 24.0, 168.0, 12.0],
        [5.0, 15.5, 125.0, 11.3],
        [8.0, 12.0, 98.0, 10.8],
        [9.0, 9.0, 60.0, 9.8],
        [10.0, 6.0, 30.0, 9.6],
        [7.0, 7.0, 0.0, 9.0],
    ]
    .into_iter()
    .filter(|p| p[2] <= top)
    .collect();
    let aorta = network.trunk("abdominal aorta", &way, 1.0);
    network.scatter_calcium(aorta, 9, [0.45, 0.97]);
    coeliac(network, aorta);
    superior_mesenteric(network, aorta);
    renals(network, aorta);
    inferior_mesenteric(network, aorta);
    lumbars(network, aorta);
    AbdominalVessels {
        external_iliac: SIDES.map(|(side, name)| iliacs(network, aorta, side, name, external_iliac)),
    }
}

fn coeliac(network: &mut Network, aorta: TrunkId) {
    let trunk = network.branch(
        aorta,
        "coeliac trunk",
        &[[7.0, 19.0, 112.0, 4.0], [7.0, 4.0, 108.0, 3.8], [8.0, -12.0, 111.0, 3.6]],
        0.4,
    );
    let hepatic = network.branch(
        trunk,
        "common hepatic artery",
        &[
            [8.0, -12.0, 111.0, 2.9],
            [-12.0, -20.0, 107.0, 2.8],
            [-35.0, -22.0, 110.0, 2.6],
            [-62.0, -14.0, 117.0, 2.0],
        ],
        1.5,
    );
    network.branch(
        hepatic,
        "gastroduodenal artery",
        &[[-28.0, -22.0, 108.0, 1.9], [-32.0, -28.0, 90.0, 1.7], [-33.0, -30.0, 62.0, 1.3]],
        1.2,
    );
    network.branch(
        trunk,
        "splenic artery",
        &[
            [8.0, -12.0, 111.0, 3.2],
            [26.0, -10.0, 107.0, 3.1],
            [46.0, 4.0, 112.0, 3.0],
            [62.0, 22.0, 106.0, 2.8],
            [84.0, 38.0, 111.0, 2.4],
            [104.0, 44.0, 108.0, 1.9],
        ],
        1.8,
    );
}

fn superior_mesenteric(network: &mut Network, aorta: TrunkId) {
    let sma = network.branch(
        aorta,
        "superior mesenteric artery",
        &[
            [8.0, 14.0, 97.0, 4.2],
            [8.0, -4.0, 90.0, 4.0],
            [8.0, -15.0, 70.0, 3.7],
            [4.0, -20.0, 42.0, 3.2],
            [-3.0, -22.0, 12.0, 2.6],
            [-16.0, -25.0, -18.0, 2.1],
            [-34.0, -28.0, -46.0, 1.6],
        ],
        1.5,
    );
    network.stenosis(sma, 0.13, 12.0, 55.0);
    let branches: [Branch<3>; 5] = [
        ("middle colic artery", [[8.0, -15.0, 66.0, 1.8], [0.0, -34.0, 58.0, 1.6], [-6.0, -52.0, 66.0, 1.2]]),
        ("jejunal artery 1", [[6.0, -17.0, 54.0, 1.9], [26.0, -24.0, 46.0, 1.7], [52.0, -34.0, 42.0, 1.2]]),
        ("jejunal artery 2", [[3.0, -20.0, 36.0, 1.8], [24.0, -28.0, 22.0, 1.6], [48.0, -40.0, 8.0, 1.2]]),
        ("ileal artery", [[-4.0, -22.0, 8.0, 1.8], [12.0, -32.0, -12.0, 1.6], [26.0, -46.0, -38.0, 1.2]]),
        (
            "ileocolic artery",
            [[-2.0, -22.0, 18.0, 1.9], [-26.0, -30.0, 4.0, 1.7], [-62.0, -26.0, -16.0, 1.2]],
        ),
    ];
    for (name, way) in branches {
        network.branch(sma, name, &way, 1.2);
    }
}

fn renals(network: &mut Network, aorta: TrunkId) {
    let left =
        [[9.0, 11.0, 84.0, 3.2], [28.0, 14.0, 80.0, 3.0], [50.0, 26.0, 78.0, 2.9], [66.0, 33.0, 80.0, 2.6]];
    let right = [
        [8.0, 10.0, 79.0, 3.2],
        [-14.0, 15.0, 72.0, 3.0],
        [-38.0, 20.0, 67.0, 2.9],
        [-64.0, 33.0, 66.0, 2.6],
    ];
    for ((side, name), way) in SIDES.into_iter().zip([right, left]) {
        let renal = network.branch(aorta, &format!("{name} renal artery"), &way, 0.8);
        let hilum = way[3];
        for (part, up, back) in [("anterior", 14.0, -3.0), ("posterior", -13.0, 4.0)] {
            let place = |out: f64, share: f64, r: f64| {
                [hilum[0] + side * out, hilum[1] + back + 5.0 * share, hilum[2] + up * share, r]
            };
            let mut from = hilum;
            from[3] = 2.0;
            let way = [from, place(8.0, 0.6, 1.8), place(20.0, 1.3, 1.3)];
            network.branch(renal, &format!("{name} renal artery, {part} branch"), &way, 0.3);
        }
        if side > 0.0 {
            network.stenosis(renal, 0.3, 12.0, 70.0);
        }
    }
}

fn inferior_mesenteric(network: &mut Network, aorta: TrunkId) {
    let way = [
        [10.0, 6.0, 34.0, 2.1],
        [18.0, -6.0, 22.0, 2.0],
        [27.0, -10.0, -8.0, 1.8],
        [22.0, 2.0, -45.0, 1.5],
        [10.0, 28.0, -90.0, 1.2],
    ];
    let trunk = network.branch(aorta, "inferior mesenteric artery", &way, 1.2);
    let way = [[26.0, -9.0, 2.0, 1.6], [48.0, -6.0, 6.0, 1.4], [84.0, 6.0, 30.0, 1.1]];
    network.branch(trunk, "left colic artery", &way, 1.0);
}

fn lumbars(network: &mut Network, aorta: TrunkId) {
    for (level, z) in [("L2", 66.0), ("L3", 40.0), ("L4", 16.0)] {
        for (side, name) in SIDES {
            let way = [
                [9.0, 9.0, z, 1.3],
                [4.0 + side * 20.0, 20.0, z - 2.0, 1.2],
                [side * 31.0, 42.0, z - 4.0, 1.1],
                [side * 38.0, 66.0, z - 8.0, 1.0],
            ];
            network.branch(aorta, &format!("{name} lumbar artery {level}"), &way, 0.2);
        }
    }
}

fn iliacs(network: &mut Network, aorta: TrunkId, side: f64, name: &str, external: &[WayPoint]) -> TrunkId {
    let mut way = on_side(
        side,
        [[0.0, 7.0, 0.0, 6.2], [14.0, 12.0, -17.0, 5.8], [31.0, 23.0, -41.0, 5.4], [40.0, 34.0, -60.0, 5.0]],
    );
    way[0][0] = 7.0;
    let common = network.branch(aorta, &format!("{name} common iliac artery"), &way, 1.2);
    network.scatter_calcium(common, 5, [0.1, 0.95]);
    let end = way[3];

    let way = on_side(side, [[40.0, 34.0, -60.0, 3.4], [43.0, 48.0, -72.0, 3.2], [46.0, 59.0, -86.0, 2.9]]);
    let internal = network.branch(common, &format!("{name} internal iliac artery"), &way, 0.5);
    let gluteal = on_side(
        side,
        [
            [46.0, 59.0, -86.0, 2.4],
            [54.0, 74.0, -94.0, 2.1],
            [70.0, 84.0, -98.0, 1.7],
            [92.0, 84.0, -100.0, 1.3],
        ],
    );
    network.branch(internal, &format!("{name} superior gluteal artery"), &gluteal, 0.8);
    let anterior =
        on_side(side, [[46.0, 59.0, -86.0, 2.2], [44.0, 56.0, -102.0, 1.9], [46.0, 48.0, -120.0, 1.5]]);
    network.branch(internal, &format!("{name} internal iliac artery, anterior trunk"), &anterior, 0.6);

    let mut way: Vec<WayPoint> = external.iter().map(|p| [side * p[0], p[1], p[2], p[3]]).collect();
    way.insert(0, [end[0], end[1], end[2], 4.6]);
    let external = network.branch(common, &format!("{name} external iliac artery"), &way, 1.2);
    network.scatter_calcium(external, 3, [0.1, 0.9]);
    external
}
