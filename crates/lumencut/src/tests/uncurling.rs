use glam::DVec3;

use super::*;

#[test]
fn a_bent_vessel_fits_at_every_amount_and_fills_the_view_at_one() {
    let points: Vec<DVec3> = (0..=60)
        .map(|n| {
            let turn = f64::from(n) * 0.1;
            DVec3::new(20.0 * turn.cos(), 20.0 * turn.sin(), -f64::from(n))
        })
        .collect();
    let vessel = Vessel::new(points, None).expect("a vessel");
    let camera = Camera::new(DVec3::ZERO, DVec3::Y, DVec3::Z, [300, 200], 1.0).expect("a camera");
    let fit = fitted_uncurling(&camera, &vessel, 0.0).expect("a view");
    let path = Arc::new(CenterlinePath::new(&vessel, 0.0).expect("a path"));
    let taken = (0..=8).map(|step| {
        let uncurl = Uncurl::new(Arc::clone(&path), fit, f64::from(step) / 8.0, None).expect("a layout");
        let extent = uncurl.extent() * 2.0 / fit.pixel_spacing();
        (extent.x / 300.0).max(extent.y / 200.0)
    });
    let most = taken.fold(0.0, f64::max);
    assert!(most > 0.85 && most < 0.9 + 1e-9, "{most}");
    assert_eq!((fit.direction(), fit.up(), fit.size()), (camera.direction(), camera.up(), camera.size()));
}
