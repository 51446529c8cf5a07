//! Input of the commands: regular files and the standard input, all of limited size.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use viscofriction::WrongInput;
use viscofriction::indenters::topography::length;
use viscofriction::numerics::InvalidParameter;
use viscofriction::scene::Source;

/// Size of an input file, \[bytes], above which it is refused. Chosen: 1 GiB, so that a wrong file does not fill the memory.
const MAX_FILE_SIZE: u64 = 1 << 30;

/// Size of a scene file, \[bytes], above which it is refused. Chosen: 16 MiB; scenes are written by hand, and large data are in
/// files of their own.
const MAX_SCENE_SIZE: u64 = 1 << 24;

/// Identity of a file independent of names and links: device and inode.
#[cfg(unix)]
type Identity = (u64, u64);
/// Identity of a file independent of symbolic links: its canonical path.
#[cfg(not(unix))]
type Identity = std::path::PathBuf;

/// Identity of an existing file; an error if there is none.
fn identity(path: &Path) -> io::Result<Identity> {
    #[cfg(unix)]
    return {
        use std::os::unix::fs::MetadataExt as _;
        path.metadata().map(|file| (file.dev(), file.ino()))
    };
    #[cfg(not(unix))]
    path.canonicalize()
}

/// Input files of this command; no option may replace them.
static INPUTS: Mutex<BTreeSet<Identity>> = Mutex::new(BTreeSet::new());

/// Protects a file from being replaced by this command; [`read_input`] does so too.
pub(crate) fn protect(path: &Path) {
    let mut inputs = INPUTS.lock().unwrap_or_else(PoisonError::into_inner);
    inputs.extend(identity(path));
}

/// True if the file is an input of this command, under any name.
pub(crate) fn is_input(path: &Path) -> bool {
    let inputs = INPUTS.lock().unwrap_or_else(PoisonError::into_inner);
    identity(path).is_ok_and(|file| inputs.contains(&file))
}

/// Reads and protects a file that a scene names, of at most `most` bytes.
pub(crate) fn read_input(path: &Path, most: u64) -> Result<Vec<u8>, WrongInput> {
    protect(path);
    read_file(path, most)
}

/// Reads and protects a table that the command line names.
pub(crate) fn read_table(path: &Path) -> Result<Vec<u8>, WrongInput> {
    protect(path);
    read_rows(path)
}

/// Reads a table that the command may also write, and does not protect it. Its size is limited to 1/32 of half of the free
/// memory: a cell has at least two bytes in the file, and takes up to 64 as a text in memory.
pub(crate) fn read_rows(path: &Path) -> Result<Vec<u8>, WrongInput> {
    read_file(path, half_of_free_memory().unwrap_or(u64::MAX) / 32)
}

/// Protects a table that the command line names; an error if it cannot be opened.
pub(crate) fn check_file(path: &Path) -> Result<(), WrongInput> {
    protect(path);
    open_regular(path)
        .map(drop)
        .map_err(|error| read_error(path, &error))
}

/// Reads a regular file of at most `most` bytes.
fn read_file(path: &Path, most: u64) -> Result<Vec<u8>, WrongInput> {
    let most = most.min(MAX_FILE_SIZE);
    let read = || {
        let file = open_regular(path)?;
        if file.metadata()?.len() > most {
            return Err(io::Error::other(format!(
                "the memory that is allowed is enough for a file of {most} bytes, and this one has more"
            )));
        }
        read_at_most(most, file)
    };
    read().map_err(|error| read_error(path, &error))
}

/// Opens a file; an error unless it is a regular one.
fn open_regular(path: &Path) -> io::Result<File> {
    if !path.metadata()?.is_file() {
        let needed = "a regular file is needed, and not a folder, a device or a pipe";
        return Err(io::Error::other(needed));
    }
    File::open(path)
}

/// Invalid input for a file that was not read, with its path.
fn read_error(path: &Path, error: &io::Error) -> WrongInput {
    WrongInput(format!("{}: {error}", path.display()))
}

/// Parameter names of the libraries with the options that set them.
const OPTIONS: [(&str, &str); 16] = [
    ("n_branches", "--branches"),
    ("branches", "--branches"),
    ("tolerance", "--parsimony"),
    ("weight", "--smoothing"),
    ("poisson_ratio", "--poisson-ratio"),
    ("reference_temperature", "--reference-temperature"),
    ("c1", "--wlf C1"),
    ("c2", "--wlf C2"),
    ("activation_energy", "--arrhenius"),
    ("spring_constant", "--spring-constant"),
    ("sensitivity", "--sensitivity"),
    ("ramp_rate", "--ramp-rate"),
    ("thickness", "--thickness"),
    ("prior", "--prior"),
    ("track_radius", "--track-radius"),
    ("run_in", "--run-in"),
];

/// Invalid input from an out-of-range parameter of a library, under the name of the option that sets it.
pub(crate) fn wrong_option(mut refused: InvalidParameter) -> WrongInput {
    let mut options = OPTIONS.iter();
    if let Some((_, option)) = options.find(|(parameter, _)| *parameter == refused.parameter) {
        refused.parameter = option;
    }
    WrongInput(refused.to_string())
}

/// Half of the available memory, \[bytes]; `None` if the system does not state it.
pub(crate) fn half_of_free_memory() -> Option<u64> {
    let table = fs::read_to_string("/proc/meminfo").ok()?;
    let free = table
        .lines()
        .find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kilobytes: u64 = free.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(512 * kilobytes)
}

/// Parses a length, in m or with a unit.
pub(crate) fn metres(text: &str) -> Result<f64, String> {
    let metres = text.trim().parse().ok().or_else(|| length(text));
    metres.ok_or_else(|| "a length is needed, in m or with a unit, as \"10 um\"".to_owned())
}

/// Reads the scene from a file, or from the standard input for `-`.
pub(crate) fn read_scene(path: &Path) -> Result<Source, WrongInput> {
    let contents = if path == Path::new("-") {
        // Protect a file that the shell redirects to the standard input.
        protect(Path::new("/dev/stdin"));
        let contents = read_at_most(MAX_SCENE_SIZE, io::stdin());
        contents.map_err(|error| WrongInput(format!("-: {error}")))?
    } else {
        read_input(path, MAX_SCENE_SIZE)?
    };
    Source::new(path, contents)
}

/// Reads at most `most` bytes; an error if there are more.
fn read_at_most(most: u64, file: impl Read) -> io::Result<Vec<u8>> {
    let mut contents = Vec::new();
    file.take(most + 1).read_to_end(&mut contents)?;
    if contents.len() as u64 > most {
        let problem = format!("there are more than {most} bytes");
        return Err(io::Error::other(problem));
    }
    Ok(contents)
}

#[cfg(test)]
mod tests {
    use clap::error::ErrorKind;

    use crate::command_line;

    #[test]
    fn every_option_in_metres_takes_units() {
        let program = command_line();
        let mut n_options = 0;
        for command in program.get_subcommands() {
            for option in command.get_arguments() {
                let help = option.get_help().map(ToString::to_string);
                if !help.is_some_and(|help| help.contains(" in m ") || help.contains(" in m,")) {
                    continue;
                }
                n_options += 1;
                let name = option.get_long().expect("an option");
                let count = option.get_num_args().map_or(1, |range| range.min_values());
                let words = std::iter::once("command".to_owned()).chain([format!("--{name}")]);
                let words = words.chain(vec!["20mm".to_owned(); count]);
                let parsed = command.clone().try_get_matches_from(words);
                // The value is accepted: the parser complains only that other arguments are missing.
                let kind = parsed.err().map(|error| error.kind());
                assert_eq!(kind, Some(ErrorKind::MissingRequiredArgument), "--{name}");
            }
        }
        assert_eq!(n_options, 7, "options that are lengths");
    }
}
