//! The command line: commands and their switches.

use std::path::PathBuf;

xflags::xflags! {
    /// Scripted experiments, benchmarks and measurements.
    cmd experiments {
        /// Runs scripted experiments (fixtures/experiments) and compares them with published values.
        cmd experiment {
            /// Which one: the name of its file without `.ron`.
            optional name: String
            /// All of them.
            optional --all
            /// With --all: those that take a quarter of a minute, too. With `scale`: worlds of 400 to 1,000 places instead.
            optional --slow
            /// Fail if a value differs from the expected one.
            optional --check
            /// Print JSON instead of tables.
            optional --json
            /// Threads of each search, 0 for one per core; 1 if not given.
            optional --threads count: usize
            /// With `chapter-4` and `scale`: seeds of each row; 50 and 5 if not given.
            optional --seeds count: usize
            /// With `scale` and `horizon`: seconds that one search may take; 60 if not given.
            optional --seconds count: u64
            /// With `chapter-4` and `scale`: the file to draw the plot into.
            optional --svg file: PathBuf
            /// The folder with street networks; the environment variable HSSH_DATA if not given.
            optional --data folder: PathBuf
        }
        /// Measures the branching factor with and without planarity beside equation (3.1).
        cmd branching {
            /// Print JSON instead of a table.
            optional --json
        }
        /// Counts the hypotheses of the basic SSH, which knows no stars, beside those of the hybrid one.
        cmd causal {
            /// Print JSON instead of tables.
            optional --json
        }
        /// Times the mapper: `speed`, `faces` or `proof`, all three if not given; `long` explorations; `kills` and the checkpoints that outlive them; `memory` beside its limit; `processes` that search together; the `size` of trees that cannot be counted; walks through `streets`; or pose graphs: `graphs`, `closures`, `wrong-closures`.
        cmd bench {
            /// Which one.
            optional name: String
            /// With `graphs` and `online`: the folder that contains `posegraph/` and `logs/`; the environment variable HSSH_DATA if not given.
            optional data: PathBuf
            /// Runs of each measurement, of which the median counts; 5 if not given.
            optional --runs count: usize
            /// Seconds that one search with proof may take; 60 if not given.
            optional --seconds count: u64
            /// With `streets`: the file to draw the plot into.
            optional --svg file: PathBuf
        }
        /// Runs one search of `bench speed`, `bench long` or `bench streets` and prints its cost as JSON; `bench` starts this itself.
        cmd measure {
            /// Which search.
            required name: String
            /// Its threads.
            required threads: usize
        }
        /// Solves the same pose graphs with hssh, GTSAM and g2o (see crates/hssh-experiments/scripts/peers.py) and compares the times.
        cmd peers {
            /// The folder that contains `posegraph/`; the environment variable HSSH_DATA if not given.
            optional data: PathBuf
            /// The Python interpreter that has gtsam and g2o; python3 if not given. May be given twice, if they
            /// cannot live in one environment.
            repeated --python interpreter: PathBuf
            /// Solves of each file, after one that does not count; 9 if not given.
            optional --runs count: usize
            /// Instead of the public graphs: a simulated campus of so many poses, such as 100000.
            optional --campus poses: usize
        }
        /// Injects wrong closures into pose graphs, those of the scans of two logs among them, and measures how far the poses
        /// then are from those without.
        cmd wrong-closures {
            /// The folder that contains `logs/` and `posegraph/`; the environment variable HSSH_DATA if not given.
            optional data: PathBuf
            /// The Python interpreter that has gtsam; without it, GTSAM is left out.
            optional --python interpreter: PathBuf
        }
        /// Makes fixtures/aces.ron from the laser log of the ACES building.
        cmd aces {
            /// The folder that contains `logs/`.
            required data: PathBuf
            /// Where to write it; fixtures/aces.ron if not given.
            optional --out file: PathBuf
        }
        /// Measures gateways, places and stars on real grid maps against what is known of the buildings.
        cmd grids {
            /// The folder that contains `gridmap/` and `logs/`.
            required data: PathBuf
        }
        /// Surveys and maps real laser logs, compares what comes out with what is known of the buildings, and fails if it is
        /// worse than it should be.
        cmd log {
            /// The folder that contains `logs/` and `relations/`.
            required data: PathBuf
            /// Also run MRPT's icp-slam and rbpf-slam on the same scans, which takes minutes; a line says so if they are not
            /// installed.
            optional --mrpt
        }
        /// Measures how often a survey errs, on real logs and simulated drives, and whether probabilities of maps are what
        /// they say.
        cmd calibrate {
            /// The folder that contains `logs/`.
            required data: PathBuf
            /// How many drives are simulated; 500 if not given.
            optional --drives count: usize
            /// Only this one, counted from 0; its account instead of tables.
            optional --drive number: usize
            /// With --drive: the file to write its log into.
            optional --out file: PathBuf
        }
        /// Injects errors of perception into explorations, and counts how often the true map is found, with readings and without.
        cmd readings {
            /// The folder of data, for the building of ACES and for streets, which are left out without.
            optional data: PathBuf
            /// Only worlds whose names begin so.
            optional --name name: String
            /// Only this rate of errors.
            optional --rate rate: f64
            /// Explorations of each row; 10 if not given.
            optional --seeds count: usize
            /// Seconds that one search may take; 20 if not given.
            optional --seconds seconds: f64
            /// Write the first exploration with errors into this file instead of searching.
            optional --out file: PathBuf
            /// Expansions after which the best map counts without a proof; 1000 if not given.
            optional --patience expansions: u64
            /// The file to draw the plot into.
            optional --svg file: PathBuf
        }
        /// Surveys and maps logs of grounds that are hard to map, with exact truth: long rings all alike, halls, lawns, people,
        /// wheels that slip.
        cmd trials {
            /// How many; 72 if not given.
            optional --trials count: usize
            /// Only those of this kind of ground.
            optional --kind name: String
            /// Only this one, counted from 0.
            optional --trial number: usize
            /// With --trial: the file to write its log into.
            optional --out file: PathBuf
        }
        /// Drives a simulated robot through seven built floors and a real one: control level, survey and map against
        /// the truth.
        cmd robot {
            /// The folder that contains `gridmap/` and `logs/`; the environment variable HSSH_DATA if not given.
            optional data: PathBuf
            /// Drives of each row; 3 if not given.
            optional --seeds count: usize
            /// Drives at once, 0 for one per core; 1 if not given.
            optional --threads count: usize
            /// Only small floors and usual noise, one drive each; fail if one goes wrong.
            optional --check
        }
        /// Compares all maps and the optimal ones with the models of the logical theory (theory/), found by clingo;
        /// fails if they differ.
        cmd theory {
            /// An exploration, with every combination of axioms.
            optional file: PathBuf
            /// More than 200 explorations: those of the thesis, small grids, random worlds, traces without stars.
            optional --all
            /// The short ones among them.
            optional --small
            /// With a file: print its facts for clingo instead.
            optional --facts
            /// Where there is no clingo, say so and succeed.
            optional --optional
            /// Explorations at once, 0 for one per core; 1 if not given.
            optional --threads count: usize
        }
    }
}
