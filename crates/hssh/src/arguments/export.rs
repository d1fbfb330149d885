//! The command line of files for other programs.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use hssh::export::{ExportKind, Spacing};

/// Files for other programs beside the answer.
#[derive(Debug, Args)]
#[command(next_help_heading = "Files for other programs")]
pub(crate) struct FilesArguments {
    /// Write the map as another program reads it, such as `--export nav2=graph.geojson`; may be given several times (see
    /// docs/exports.md). nav2: graph of its Route Server; open-rmf: navigation graph; tmap: map of topological_navigation; osmag: areas
    /// and passages; graphml: places and ways with all that is known of them; geojson: places and ways as points and lines. Of grid
    /// maps also regions: GeoJSON polygons, and labels: PNG with a color for each region; of logs also tum: trajectory, and g2o: pose
    /// graph.
    #[arg(long, value_name = "KIND=FILE", value_parser = export)]
    pub(crate) export: Vec<(ExportKind, PathBuf)>,
    #[command(flatten)]
    pub(crate) spacing: SpacingArguments,
}

/// How ways are parted.
#[derive(Debug, Args)]
pub(crate) struct SpacingArguments {
    /// With nav2, open-rmf and tmap: put further nodes on ways so that no two neighbors are farther apart than this many metres;
    /// corners of ways are nodes in any case [default: 5].
    #[arg(long, value_name = "METRES", value_parser = spacing, help_heading = "Files for other programs")]
    pub(crate) spacing: Option<Spacing>,
}

impl SpacingArguments {
    pub(crate) fn choice(&self) -> Spacing {
        self.spacing.unwrap_or_default()
    }
}

#[derive(Debug, Args)]
pub(crate) struct ExportArguments {
    /// What `hssh map --json` or `hssh stars --json` printed; `-` reads standard input.
    pub(crate) answer: PathBuf,
    /// For which program.
    #[arg(long, value_enum, value_name = "KIND")]
    pub(crate) to: ExportKind,
    /// Where to write it; without it, it is printed.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// Export the map of this rank, even if it may well be wrong; without it the best map, if there is one and it is not doubtful.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) rank: Option<u32>,
    #[command(flatten)]
    pub(crate) spacing: SpacingArguments,
}

fn export(text: &str) -> Result<(ExportKind, PathBuf), String> {
    let kinds = || {
        let names = ExportKind::value_variants().iter().map(ExportKind::to_string);
        names.collect::<Vec<_>>().join(", ")
    };
    let usage = || format!("write KIND=FILE, where KIND is one of {}", kinds());
    let (kind, file) = text.split_once('=').filter(|(_, file)| !file.is_empty()).ok_or_else(usage)?;
    Ok((ExportKind::from_str(kind, false).map_err(|_| usage())?, PathBuf::from(file)))
}

fn spacing(text: &str) -> Result<Spacing, String> {
    let metres = text.parse().ok().and_then(Spacing::new);
    metres.ok_or_else(|| format!("write a number of metres, no less than {}, like 2.5", Spacing::LEAST))
}
