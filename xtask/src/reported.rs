//! A folder of faults that users reported, run again: what the program said of each then, what it says now, and the test that holds it.
//!
//! A fault is a folder with the inputs and a `case.txt`: commands behind `$`, what came of them, and what is right in words. What can be checked
//! of those words stands in [`HELD`], beside the test that checks more; nothing here or in the program looks at an input's name.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use xshell::{Shell, cmd};

use crate::root;

/// How long one command may take, in seconds: a program that hangs is a line of the table, too.
const PATIENCE: &str = "300";
/// How much of a sentence the table shows.
const SHOWN: usize = 72;

/// What is known of a fault beside its `case.txt`.
struct Held {
    /// What its folder's name begins with.
    case: &'static str,
    /// Commands that its text tells in words only.
    also: &'static [&'static str],
    /// For each command what its first line has to contain, behind ` … ` what has to follow anywhere, and its exit code; the last one is that of
    /// all others.
    right: &'static [(&'static str, i32)],
    test: &'static str,
}

const fn held(
    case: &'static str,
    also: &'static [&'static str],
    right: &'static [(&'static str, i32)],
    test: &'static str,
) -> Held {
    Held { case, also, right, test }
}

/// A closed map of six places on five paths.
const MAPPED: (&str, i32) =
    ("posterior with proof: proved the best map (7 of 7 travels explained) … 5 6 0 yes", 0);
const PROVED: (&str, i32) = (" … proved the best map (", 0);
const REFUSED: (&str, i32) = ("error: ", 2);
/// An exit code that depends on how fast the machine is.
const ANY: i32 = i32::MIN;
const STOPPED: (&str, i32) = (" … stopped by", 3);

/// `hssh map` of the good drive with one more line of odometry, at a distance in metres.
macro_rules! jump {
    ($metres:literal) => {
        concat!(
            "gzip -dc ../00-control/control.log.gz | awk '{ print } NR == 300 { print \"ODOM ",
            $metres,
            " 0 0 0 0 0 1 nohost 1\" }' | hssh map - --planar"
        )
    };
}

const HELD: &[Held] = &[
    held(
        "00",
        &["hssh map control.log.gz --planar"],
        &[MAPPED],
        "log::a_log_becomes_the_map_of_its_building",
    ),
    held(
        "01",
        &[],
        &[("12 poses, 13 edges, of which 2 close loops", 0)],
        "text::no_mark_and_no_line_end_hides_a_record",
    ),
    held("02", &[], &[("none closes a loop", 0)], "graph::a_chain_has_nothing_to_contradict"),
    held("04", &[], &[("2 priors", 0)], "text::priors_hold_poses_in_the_world"),
    held("05", &[], &[("of which 2 close loops", 0)], "text::switches_and_mixtures_are_doubtful_closures"),
    held("07", &[], &[MAPPED], "carmen::the_laser_sits_where_the_log_says"),
    held("08", &[], &[MAPPED], "carmen::a_beam_without_a_range_is_one_that_brought_nothing"),
    held(
        "10",
        &["hssh map param-end.log.gz --planar"],
        &[("", 0), MAPPED],
        "carmen::the_limit_of_the_laser_is_that_of_the_whole_log",
    ),
    held("11", &[], &[REFUSED], "carmen::nothing_is_made_of_a_log_in_which_nothing_came_back"),
    held("14", &[], &[MAPPED], "carmen::the_odometry_may_start_anew"),
    held(
        "16",
        &["hssh stars 08d-negate-true.yaml --detail"],
        &[("2 regions, 3 places", 0), ("2 regions, 8 places", 0)],
        "map_server::every_writer_of_maps_is_understood",
    ),
    held(
        "17",
        &["hssh stars 09-humble-free025.yaml --detail"],
        &[("2 regions, 3 places", 0), ("2 regions, 8 places", 0)],
        "map_server::every_writer_of_maps_is_understood",
    ),
    held("19", &[], &[("12 poses", 0)], "text::a_direction_may_be_unmeasured"),
    held("20", &[], &[("53", 0)], "graph::every_part_says_what_holds_it"),
    held("23", &[], &[("close", 0)], "text::isam_writes_square_roots"),
    held("f01", &[], &[REFUSED], "map_server::numbers_out_of_proportion_are_refused"),
    held("f02", &[], &[REFUSED], "faults::what_is_wrong_with_an_input_is_said_first"),
    held(
        "f03",
        &[jump!("50"), jump!("1e15"), jump!("1e308")],
        &[("", 0)],
        "mutations::damaged_logs_are_read_or_refused",
    ),
    held(
        "r01",
        &[],
        &[REFUSED, ("is the input under another name", 2), ("ring: 4 places", 0), REFUSED],
        "outputs::no_output_goes_over_the_input",
    ),
    held(
        "r02",
        &[
            "cp ../r07*/gen.py .; python3 gen.py ringlaps 1000 0.05 1 odo 10 > R1000.ron; hssh map R1000.ron --planar --top 1",
        ],
        &[PROVED],
        "posterior::what_comes_after_the_proof_withdraws_nothing_and_has_an_end",
    ),
    held(
        "r04",
        &["python3 gen.py ringlaps 1000 0.05 1 odo 10 > R1000.ron; hssh map R1000.ron --planar --top 1"],
        &[PROVED],
        "posterior::what_comes_after_the_proof_withdraws_nothing_and_has_an_end",
    ),
    held("r05", &[], &[REFUSED, ("error: ", 1)], "faults::what_is_wrong_with_an_input_is_said_first"),
    held("r07", &[], &[(" … posterior with proof", ANY)], "limits::no_time_for_the_set_up"),
    held(
        "r08",
        &[
            "hssh map ../r17*/snake8.ron --planar --search breadth-first & sleep 3; kill -TERM $!",
            "hssh map ../r17*/snake8.ron --planar --search breadth-first & sleep 3; kill -HUP $!",
            "hssh map ../r17*/snake8.ron --planar --search breadth-first & sleep 3; kill -INT $!",
        ],
        // The first one is over before the signal comes, where the machine is fast.
        &[("", ANY), (" … interrupted (", 3)],
        "signals::a_search_that_is_ended_shows_what_got_farthest",
    ),
    held(
        "r10",
        &[],
        &[REFUSED, ("2 regions, 5 places", 2), ("14 travels, 14 with odometry", 2), REFUSED],
        "outputs::outputs_are_tried_first, a_full_disk_loses_only_what_was_to_go_there",
    ),
    held("r11", &[], &[REFUSED], "map_server::numbers_out_of_proportion_are_refused"),
    held("r13", &[], &[PROVED], "program::the_main_job"),
    held(
        "r14",
        &[],
        &[("", 0), REFUSED],
        "kinds::endless_words_are_not_repeated, text::nothing_endless_is_kept_or_shown",
    ),
    held(
        "r16",
        &[],
        &[
            PROVED,
            ("DOUBTFUL: travel 2: theta is 90", 0),
            ("DOUBTFUL: travel 1: the heading", 0),
            ("5 travels … question: travel 2: theta is 90", 0),
        ],
        "program::degrees_are_asked_about",
    ),
    held("r17", &[], &[STOPPED], "limits::no_time_to_look_at_a_level"),
    held("r19", &[], &[STOPPED], "checkpoints::a_search_that_is_stopped_says_how_to_go_on"),
    held("r20", &[], &[REFUSED], "outputs::two_outputs_are_two_files"),
    held("r22", &[], &[REFUSED], "program::useless_options_are_refused"),
    held(
        "r23",
        &["hssh stars nosuch"],
        &[("{", 0), ("{", 0), REFUSED],
        "program::what_is_printed_is_read_back",
    ),
];

/// A command of a fault, and what came of it when it was reported.
struct Reported {
    line: String,
    before: String,
}

/// `cargo xtask faults FOLDER`: prints the table, a line for each command.
pub(crate) fn run(folder: &str) -> Result<(), Box<dyn Error>> {
    let shell = Shell::new()?;
    let work = shell.create_temp_dir()?;
    let folder = fs::canonicalize(folder).map_err(|error| format!("{folder}: {error}"))?;
    shell.change_dir(root::root());
    cmd!(shell, "cargo test --quiet --workspace --test suite --no-run").run()?;
    let here = work.path();
    cmd!(shell, "cp -r --no-preserve=mode {folder}/. {here}").run()?;
    let mut cases: Vec<PathBuf> = fs::read_dir(here)?
        .filter_map(|entry| entry.ok().map(|entry| entry.path()))
        .filter(|case| case.join("case.txt").is_file())
        .collect();
    cases.sort();
    if cases.is_empty() {
        return Err(format!("{}: no folder in it has a case.txt", folder.display()).into());
    }
    println!("| case | command | before | after | right | test |\n|---|---|---|---|---|---|");
    let wrong = cases.iter().map(|case| again(case)).sum::<Result<usize, _>>()?;
    if wrong == 0 { Ok(()) } else { Err(format!("{wrong} of the answers are not what is right").into()) }
}

/// Runs the commands of a fault and prints a line for each. How many of the answers are wrong.
fn again(case: &Path) -> Result<usize, Box<dyn Error>> {
    let name = case.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let held = HELD.iter().find(|held| name.split('-').next() == Some(held.case));
    let mut commands = reported(&fs::read_to_string(case.join("case.txt"))?);
    let before = commands.first().map_or_else(String::new, |first| first.before.clone());
    let also = held.map_or(&[][..], |held| held.also).iter();
    commands.extend(also.flat_map(|line| steps(line)).map(|line| Reported { line, before: before.clone() }));
    take_for_granted(case, &commands)?;
    let (mut count, mut wrong) = (0, 0);
    for command in &commands {
        let output = execute(case, &command.line)?;
        if !command.line.contains("hssh ") {
            continue;
        }
        let right = held.and_then(|held| held.right.get(count).or(held.right.last()));
        count += 1;
        let (first, exit) = (first_line(&output), output.status.code().unwrap_or(-1));
        let is_right =
            right.map(|(says, code)| does_say(&output, &first, says) && (*code == ANY || exit == *code));
        wrong += usize::from(is_right == Some(false));
        println!(
            "| {name} | `{}` | {} | {} [exit {exit}] | {} | {} |",
            cell(&command.line),
            cell(&command.before),
            cell(&first),
            is_right.map_or("?", |is_right| if is_right { "yes" } else { "NO" }),
            held.map_or("", |held| held.test)
        );
    }
    Ok(wrong)
}

/// The commands of a `case.txt`, each with the first sentence of what came of it and its exit code where one is told.
fn reported(text: &str) -> Vec<Reported> {
    let happened = text.split("what is right:").next().unwrap_or_default();
    let mut found: Vec<Reported> = Vec::new();
    // Commands that stand together have what came of them behind the last one.
    let mut open = 0;
    for line in happened.lines().filter(|line| !line.trim().is_empty()) {
        if let Some(command) = line.strip_prefix("$ ") {
            if found[open..].iter().any(|command| !command.before.is_empty()) {
                open = found.len();
            }
            found.extend(steps(command).into_iter().map(|line| Reported { line, before: String::new() }));
        } else if line.starts_with("hssh ") && !happened.contains("\n$ ") {
            let command = line.split("  (").next().unwrap_or_default().split(": ").next().unwrap_or_default();
            let line = line.to_owned();
            found.push(Reported { line: command.to_owned(), before: line });
        }
        let told = |before: &mut String| {
            if before.is_empty() {
                *before = line.to_owned();
            } else if line.starts_with("[exit ") {
                *before = format!("{} {line}", before.chars().take(SHOWN - 9).collect::<String>());
            }
        };
        if !line.starts_with("$ ") {
            found[open..].iter_mut().for_each(|command| told(&mut command.before));
        }
    }
    found
}

/// The commands of a line of the shell, one by one; together where one waits for the other.
fn steps(line: &str) -> Vec<String> {
    let line = line.split("  #").next().unwrap_or_default().trim();
    if line.contains("$!") {
        return vec![format!("{line}; wait $!")];
    }
    let (mut steps, mut depth) = (vec![String::new()], 0);
    for letter in line.chars() {
        match letter {
            '(' => depth += 1,
            ')' => depth -= 1,
            ';' if depth == 0 => {
                steps.push(String::new());
                continue;
            }
            _ => {}
        }
        steps.last_mut().expect("one is there from the beginning").push(letter);
    }
    steps.iter().map(|step| step.trim().to_owned()).collect()
}

/// The fixtures of the repository, and a drive.
fn take_for_granted(case: &Path, commands: &[Reported]) -> Result<(), Box<dyn Error>> {
    let fixtures = root::root().join("fixtures");
    let names = |what: &str| commands.iter().any(|command| command.line.contains(what));
    if names("fixtures/") {
        execute(case, &format!("cp -r '{}' fixtures", fixtures.display()))?;
    }
    if names("robot.log") {
        execute(case, "hssh simulate --floor ring -o robot.log")?;
    }
    Ok(())
}

fn execute(case: &Path, line: &str) -> Result<Output, Box<dyn Error>> {
    let program = root::built("hssh");
    let folder = program.parent().unwrap_or(Path::new(".")).display().to_string();
    let path = std::env::var("PATH").unwrap_or_default();
    let mut command = Command::new("timeout");
    command.args(["-k", "10", PATIENCE, "sh", "-c", line]).current_dir(case);
    Ok(command.env("PATH", format!("{folder}:{path}")).output()?)
}

/// The first line of what was printed; of what is wrong, if that is all.
fn first_line(output: &Output) -> String {
    let said = if output.stdout.is_empty() { &output.stderr } else { &output.stdout };
    String::from_utf8_lossy(said).lines().next().unwrap_or_default().to_owned()
}

/// Whether the first line has the words before ` … `, and what was printed those behind, whatever space is between words.
fn does_say(output: &Output, first: &str, says: &str) -> bool {
    let told = String::from_utf8_lossy(&output.stdout);
    let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
    let (begins, rest) = says.split_once(" … ").unwrap_or((says, ""));
    first.contains(begins) && told.contains(rest)
}

/// As much of a text as the table shows.
fn cell(text: &str) -> String {
    let text: String = text.replace('|', "\\|").replace('\u{feff}', "");
    if text.chars().count() <= SHOWN { text } else { text.chars().take(SHOWN - 1).chain(['…']).collect() }
}
