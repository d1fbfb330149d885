use hssh_topology::*;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let n: i32 = a[1].parse().unwrap();
    let m: i32 = a[2].parse().unwrap();
    let planar = a[3] == "p";
    let bound = a.get(4).and_then(|x| x.parse().ok());
    let mut route = vec![];
    for r in 0..n {
        let cols: Vec<i32> = if r % 2 == 0 { (0..m).collect() } else { (0..m).rev().collect() };
        for c in cols {
            route.push((r, c));
        }
    }
    let (mut r, c0) = *route.last().unwrap();
    let east = c0 == m - 1;
    let mut down = false;
    let _ = &mut r;
    for k in 0..m {
        let c = if east { m - 1 - k } else { k };
        let rows: Vec<i32> = if down { (0..n).collect() } else { (0..n).rev().collect() };
        for rr in rows {
            if route.last() != Some(&(rr, c)) {
                route.push((rr, c));
            }
        }
        down = !down;
    }
    let star = |(r, c): (i32, i32)| -> Star {
        format!(
            "{} {} {} {}",
            if r > 0 { "0+" } else { "(0+)" },
            if c < m - 1 { "1+" } else { "(1+)" },
            if r < n - 1 { "0-" } else { "(0-)" },
            if c > 0 { "1-" } else { "(1-)" }
        )
        .parse()
        .unwrap()
    };
    let dir = |a: (i32, i32), b: (i32, i32)| match (b.0 - a.0, b.1 - a.1) {
        (-1, 0) => 0,
        (0, 1) => 1,
        (1, 0) => 2,
        (0, -1) => 3,
        x => panic!("{x:?}"),
    };
    let mut cat = StarCatalog::new();
    let start = cat.intern(&star(route[0]));
    let obs: Vec<Observation> = route
        .windows(2)
        .map(|w| Observation {
            exit: Olp(dir(w[0], w[1])),
            entry: Olp(dir(w[1], w[0])),
            star: cat.intern(&star(w[1])),
        })
        .collect();
    let ax = Axioms {
        max_genus: planar.then_some(0),
        max_places: bound,
        no_circular_path: a.get(5).is_none(),
        ..Axioms::default()
    };
    let t = std::time::Instant::now();
    let threads: usize = a.get(6).and_then(|x| x.parse().ok()).unwrap_or(1);
    let exp = hssh_search::Experience { catalog: cat, start, observations: obs };
    if a.get(7).is_none() {
        let r = hssh_search::count(
            &exp,
            &ax,
            Preference::default(),
            Default::default(),
            threads,
            &Default::default(),
        )
        .unwrap();
        println!("count {:?}\n{r}", t.elapsed());
    }
    for strategy in [
        hssh_search::Strategy::BreadthFirst,
        hssh_search::Strategy::BestFirst(hssh_search::Goal::AnyMap),
        hssh_search::Strategy::Proof(hssh_search::Goal::AnyMap),
    ] {
        if a.get(7).is_some_and(|x| x == "p") && strategy == hssh_search::Strategy::BreadthFirst {
            continue;
        }
        let t = std::time::Instant::now();
        let mut m = hssh_search::Mapper::builder()
            .axioms(ax)
            .strategy(strategy)
            .threads(threads)
            .limits(hssh_search::Limits { bytes: Some(8_000_000_000), ..Default::default() })
            .start(exp.catalog.star(start))
            .unwrap();
        let mut star = start;
        for o in &exp.observations {
            m.observe(o.exit, o.entry, exp.catalog.star(o.star)).unwrap();
            star = o.star;
        }
        let _ = star;
        m.advance();
        println!("{:?} advance", t.elapsed());
        let r2 = m.report();
        println!(
            "{:?}\n{r2} {} bytes {:.1}",
            t.elapsed(),
            r2.tree_bytes,
            r2.tree_bytes as f64 / r2.nodes as f64
        );
    }
}
