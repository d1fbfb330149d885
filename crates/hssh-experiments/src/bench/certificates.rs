//! Certificates: how long it takes to check by itself what a search has proved.

use std::error::Error;
use std::time::Instant;

use hssh_causal::Exploration;
use hssh_search::{Goal, Mapper, MapperBuilder, Order, PosteriorModel};
use hssh_topology::Axioms;
use hssh_verify::verify;
use hssh_world::{PolarNoise, grid, snake};

use crate::table::{aligned, grouped};

/// The grids of which the preferred map is proved.
const SIZES: [u32; 4] = [3, 4, 5, 6];

/// Standard deviations a travel of chapter 4: m, and a tenth of it in rad.
const NOISES: [f64; 4] = [0.1, 0.3, 0.6, 1.0];

/// Grids by preference, ACES and chapter 4 by posterior; one thread.
pub(super) fn run() -> Result<(), Box<dyn Error>> {
    let heads = ["", "proof, s", "expanded", "open", "MB", "check, s", "verdict"];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    let planar = || Mapper::builder().axioms(Axioms { max_genus: Some(0), ..Axioms::default() });
    for size in SIZES {
        let world = grid(size, size, 8.0)?;
        let exploration = world.explore(&world.route_through(&snake(size, size))?)?;
        rows.push(row(&format!("{size}×{size}"), &exploration, planar().order(Order::Proof))?);
    }
    let aces = Exploration::from_ron(include_str!("../../../../fixtures/aces.ron"))?;
    rows.push(row("ACES", &aces, by_posterior(planar(), &aces)?)?);
    let world = grid(4, 4, 8.0)?;
    let route = world.route_through(&snake(4, 4))?;
    for noise in NOISES {
        let model = PolarNoise {
            distance: noise,
            distance_share: 0.0,
            bearing: noise / 10.0,
            rotation: noise / 10.0,
        };
        let exploration = world.explore_with_odometry(&route, &model, 1)?;
        rows.push(row(
            &format!("chapter 4, {noise}, evidence"),
            &exploration,
            by_posterior(planar(), &exploration)?,
        )?);
        let thesis = planar().posterior(PosteriorModel::THESIS).order(Order::Cyclic).goal(Goal::ClosedMap);
        rows.push(row(&format!("chapter 4, {noise}, integrated"), &exploration, thesis)?);
    }
    println!("{}", aligned(&rows));
    Ok(())
}

fn by_posterior(search: MapperBuilder, exploration: &Exploration) -> Result<MapperBuilder, Box<dyn Error>> {
    let model = PosteriorModel::evidence(exploration).ok_or("no odometry")?;
    Ok(search.posterior(model).order(Order::Cyclic))
}

fn row(name: &str, exploration: &Exploration, search: MapperBuilder) -> Result<Vec<String>, Box<dyn Error>> {
    let started = Instant::now();
    let mapper = search.explain(exploration)?;
    let proof = started.elapsed().as_secs_f64();
    let certificate = mapper.certificate(exploration).ok_or_else(|| format!("{name}: nothing is proved"))?;
    let started = Instant::now();
    let verdict = verify(&certificate, exploration).map_err(|refusal| format!("{name}: {refusal}"))?;
    Ok(vec![
        name.to_owned(),
        format!("{proof:.3}"),
        grouped(verdict.expanded),
        grouped(verdict.open),
        format!("{:.2}", certificate.len() as f64 / 1e6),
        format!("{:.3}", started.elapsed().as_secs_f64()),
        format!("holds; {} on trust", verdict.on_trust.len()),
    ])
}
