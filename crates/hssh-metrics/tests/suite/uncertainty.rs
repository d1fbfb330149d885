//! Covariances cannot be wrong, and travel between frames as samples do.

use hssh_metrics::{Covariance, Information, Pose, UncertainPose, UncertaintyError};
use nalgebra::{Matrix3, Vector3, matrix};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::generic_covariance;

#[test]
fn refuses_what_is_no_covariance() {
    let error = |matrix| Covariance::new(matrix).unwrap_err();
    let unit = Matrix3::identity();
    assert!(matches!(
        error(matrix![1.0, 0.0, 0.0; 0.0, f64::NAN, 0.0; 0.0, 0.0, 1.0]),
        UncertaintyError::NotFinite { row: 2, column: 2, .. }
    ));
    assert!(matches!(error(unit * f64::INFINITY), UncertaintyError::NotFinite { .. }));
    assert_eq!(
        error(matrix![1.0, 0.5, 0.0; 0.4, 1.0, 0.0; 0.0, 0.0, 1.0]).to_string(),
        "not symmetric: row 1, column 2 is 0.5, but row 2, column 1 is 0.4"
    );
    assert_eq!(error(-unit), UncertaintyError::NotPositiveDefinite(-1.0));
    assert!(matches!(error(Matrix3::zeros()), UncertaintyError::NotPositiveDefinite(_)));
    assert!(matches!(
        error(matrix![1.0, 2.0, 0.0; 2.0, 1.0, 0.0; 0.0, 0.0, 1.0]),
        UncertaintyError::NotPositiveDefinite(_)
    ));
    assert!(matches!(
        error(Matrix3::from_diagonal(&[1.0, 1.0, 1e-15].into())),
        UncertaintyError::IllConditioned(_)
    ));
    assert!(Covariance::from_standard_deviations(1.0, 0.0, 1.0).is_err());
    assert!(Covariance::new(unit * 1e-200).is_ok());
    assert!(Covariance::new(unit * 1e200).is_ok());
}

#[test]
fn conversions_invert_each_other() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    for _ in 0..50 {
        let covariance = generic_covariance(&mut random);
        let information = covariance.information();
        let product = covariance.matrix() * information.matrix();
        assert!((product - Matrix3::identity()).amax() < 1e-10);
        assert!((information.covariance().unwrap().matrix() - covariance.matrix()).amax() < 1e-12);
        assert!((information.log_determinant() + covariance.log_determinant()).abs() < 1e-10);
        assert!((covariance.log_determinant() - covariance.matrix().determinant().ln()).abs() < 1e-10);
        // Rotating commutes with inverting, and turning back undoes it.
        let rotated = covariance.rotated(0.8).information();
        assert!((rotated.matrix() - information.rotated(0.8).matrix()).amax() < 1e-10);
        assert!((rotated.rotated(-0.8).matrix() - information.matrix()).amax() < 1e-10);
    }
}

#[test]
fn the_worst_accepted_matrix_survives_every_conversion() {
    let worst = Matrix3::from_diagonal(&[1e7, 1.1e-7, 1.0].into());
    let covariance = Covariance::new(worst).unwrap();
    for theta in [0.0, 0.7, 1.5, 3.0] {
        let turned = covariance.rotated(theta);
        assert!(turned.log_determinant().is_finite());
        assert!(turned.information().covariance().unwrap().log_determinant().is_finite());
        assert!(turned.information().rotated(1.0).covariance().unwrap().log_determinant().is_finite());
    }
}

#[test]
fn a_right_angle_exchanges_the_axes() {
    let covariance = Covariance::from_standard_deviations(1.0, 2.0, 3.0).unwrap();
    let turned = covariance.rotated(std::f64::consts::FRAC_PI_2);
    let expected = Matrix3::from_diagonal(&[4.0, 1.0, 9.0].into());
    assert!((turned.matrix() - expected).amax() < 1e-14);
    assert!(Information::identity().rotated(0.3).log_determinant().abs() < 1e-14);
}

/// Monte Carlo is the oracle: it shares nothing with the first-order formula but the group.
#[test]
fn compounding_agrees_with_sampling() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let small = Covariance::new(matrix![4e-4, 1e-4, 0.0; 1e-4, 2e-4, -2e-5; 0.0, -2e-5, 1e-4]).unwrap();
    let link = |x, y, theta| UncertainPose { mean: Pose::new(x, y, theta), covariance: small };
    let chain = [link(2.0, 1.0, 0.9), link(-1.0, 3.0, -2.8), link(0.5, 0.5, 3.1)];
    let compound = UncertainPose::compound(&chain).unwrap().unwrap();
    let root = small.matrix().cholesky().unwrap().l();
    let mut sum = Matrix3::zeros();
    let samples = 40_000;
    for _ in 0..samples {
        let sample = chain.iter().fold(Pose::IDENTITY, |sofar, link| {
            let noise = root * Vector3::from_fn(|_, _| StandardNormal.sample(&mut random));
            sofar.compose(Pose::new(link.mean.x + noise.x, link.mean.y + noise.y, link.mean.theta + noise.z))
        });
        let turn = hssh_metrics::wrap_angle(sample.theta - compound.mean.theta);
        let deviation = Vector3::new(sample.x - compound.mean.x, sample.y - compound.mean.y, turn);
        sum += deviation * deviation.transpose();
    }
    let sampled = sum / f64::from(samples);
    let difference = (sampled - compound.covariance.matrix()).amax();
    assert!(
        difference < 0.03 * compound.covariance.matrix().amax(),
        "{sampled}{}",
        compound.covariance.matrix()
    );
}

#[test]
fn inverting_twice_gives_the_covariance_back() {
    let mut random = ChaCha8Rng::seed_from_u64(2);
    for mean in crate::awkward_poses() {
        let uncertain = UncertainPose { mean, covariance: generic_covariance(&mut random) };
        let again = uncertain.inverse().unwrap().inverse().unwrap();
        assert!((again.covariance.matrix() - uncertain.covariance.matrix()).amax() < 1e-10);
    }
    assert_eq!(UncertainPose::compound([]), Ok(None));
}

/// What is zero in some direction is the same again when it is written and read, to the last bit, whichever way it rounds.
#[test]
fn a_semidefinite_matrix_is_the_same_again() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    for rank in [1, 2] {
        for _ in 0..2_000 {
            let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
            let scale = 10.0_f64.powf(3.0 * normal());
            let directions = Matrix3::from_fn(|_, column| if column < rank { scale * normal() } else { 0.0 });
            let singular = directions * directions.transpose();
            // Two nearly parallel directions are none, or too close to singular.
            let Ok(once) = Information::semidefinite(0.5 * (singular + singular.transpose())) else {
                continue;
            };
            assert_eq!(Information::semidefinite(*once.matrix()), Ok(once), "{singular}");
            assert!((once.matrix() - singular).amax() <= 1e-8 * singular.amax(), "{singular}");
            if rank == 1 {
                assert_eq!((once.rank(), once.covariance()), (1, None), "{singular}");
            }
        }
    }
}

/// Of a matrix that is mirrored to the last digit leading minors tell at a glance that it is definite; of one that is off by a rounding error
/// Cholesky's factors tell. Eigenvalues know better than both.
#[test]
fn what_is_seen_at_a_glance_is_what_a_closer_look_sees() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
    let (mut accepted, mut refused) = (0, 0);
    for _ in 0..20_000 {
        let axes = Matrix3::from_fn(|_, _| normal()).qr().q();
        let scale = 10_f64.powf(60.0 * normal());
        let eigenvalues =
            Vector3::from_fn(|_, _| scale * 10_f64.powf(4.0 * normal()) * (normal() + 1.5).signum());
        let turned = axes * Matrix3::from_diagonal(&eigenvalues) * axes.transpose();
        let matrix = 0.5 * (turned + turned.transpose());
        let mut rounded = matrix;
        rounded[(1, 0)] = rounded[(1, 0)].next_up();
        let (glance, look) = (Covariance::new(matrix), Covariance::new(rounded));
        let (least, most) = (eigenvalues.min(), eigenvalues.max());
        if least < 0.0 && -least > 1e-9 * most || most > 1e15 * least.abs() {
            assert!(glance.is_err() && look.is_err(), "{matrix}");
            refused += 1;
        } else if least > 0.0 && most < 1e12 * least {
            assert!(glance.is_ok() && look.is_ok(), "{matrix}");
            accepted += 1;
        }
        assert!(glance.is_err() || glance.unwrap().matrix() == &matrix);
    }
    assert!(accepted > 1_000 && refused > 1_000, "{accepted} {refused}");
}
