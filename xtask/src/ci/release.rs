//! `release`: everything that is published, in one folder, each part tried where nothing of the workspace is installed.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};

use super::cargo::{Transcript, cargo, run, workspace_root};
use super::workspace::{Package, Workspace};
use super::{PACKAGES, book, step};

/// The program that the installed Python package has to run: a first computation, as a user would write it.
const PROGRAM: &str = "import viscofriction as vf; friction = vf.slide(vf.Cone(0.1), vf.Viscous(1e4), normal_force=1.0, velocity=0.01); \
     print(vf.__version__, friction.mu, '±', friction.mu_error)";

/// Makes the packed crates, the wheel, the source distribution and the book, and tries them.
pub(crate) fn release(out: &Path) -> Result<()> {
    let exists = out.exists();
    ensure!(!exists, "{} is there already: remove it", out.display());
    fs::create_dir_all(out)?;
    let release = Release {
        workspace: Workspace::read()?,
        out: out.canonicalize()?,
    };
    let mut transcript = Transcript::default();
    step(&mut transcript, "crates", |transcript| {
        release.pack(transcript)
    })?;
    step(&mut transcript, "their examples", |_| {
        release.compile_examples()
    })?;
    step(&mut transcript, "Python", |_| release.python())?;
    step(&mut transcript, "book", |_| release.book())
}

/// A release in the making.
struct Release {
    /// Crates that are published, and the folder where cargo builds.
    workspace: Workspace,
    /// All folders are in this one: `crates`, `python`, `book`, and `trial`, which is not published.
    out: PathBuf,
}

impl Release {
    /// Packs and compiles each crate, copies the packed files to `crates`, and unpacks them in `trial`.
    fn pack(&self, transcript: &mut Transcript) -> Result<()> {
        transcript.cargo(&format!("package {PACKAGES} --no-verify"))?;
        let (packed, trial) = (self.out.join("crates"), self.out.join("trial"));
        fs::create_dir_all(&packed)?;
        fs::create_dir_all(&trial)?;
        for package in &self.workspace.packages {
            let file = format!("{}.crate", package.full_name());
            let made = self.workspace.target_directory.join("package").join(&file);
            fs::copy(made, packed.join(&file)).context(file.clone())?;
            let crate_file = packed.join(&file);
            let mut tar = Command::new("tar");
            run(tar.arg("xzf").arg(crate_file).arg("-C").arg(&trial))?;
        }
        Ok(())
    }

    /// Checks a project whose programs are the examples of the packed READMEs, and that knows the packed crates only.
    fn compile_examples(&self) -> Result<()> {
        let trial = self.out.join("trial");
        let programs = trial.join("examples/src/bin");
        fs::create_dir_all(&programs)?;
        let mut manifest =
            "[package]\nname = \"examples\"\nedition = \"2024\"\n\n[dependencies]\n".to_owned();
        let mut patch = "\n[workspace]\n\n[patch.crates-io]\n".to_owned();
        for package in &self.workspace.packages {
            let (name, folder) = (&package.name, package.full_name());
            writeln!(manifest, "{name} = \"{}\"", package.version)?;
            writeln!(patch, "{name} = {{ path = \"../{folder}\" }}")?;
            let page = fs::read_to_string(trial.join(folder).join("README.md"))?;
            let example = example(&page);
            ensure!(
                example.is_some() || package.is_program(),
                "{name} has no example in its README"
            );
            if let Some(example) = example {
                fs::write(programs.join(format!("{name}.rs")), example)?;
            }
        }
        let project = trial.join("examples");
        fs::write(project.join("Cargo.toml"), manifest + &patch)?;
        fs::copy(
            workspace_root().join("Cargo.lock"),
            project.join("Cargo.lock"),
        )?;
        let mut check = cargo("check --release --bins");
        let target = &self.workspace.target_directory;
        run(check.current_dir(project).env("CARGO_TARGET_DIR", target))
    }

    /// Makes the source distribution and, from it, the wheel; installs the wheel into a new environment and runs [`PROGRAM`]
    /// there.
    fn python(&self) -> Result<()> {
        let made = self.out.join("python");
        let builder = self.environment("builder", "maturin>=1.16,<2")?;
        let mut maturin = Command::new(builder.join("maturin"));
        let arguments = "build --release --sdist --manifest-path python/Cargo.toml --out";
        maturin.args(arguments.split(' ')).arg(&made);
        maturin.current_dir(workspace_root());
        run(maturin.env("CARGO_TARGET_DIR", &self.workspace.target_directory))?;
        let entries = fs::read_dir(made)?.collect::<Result<Vec<_>, _>>()?;
        let files = entries.iter().map(fs::DirEntry::path);
        let mut wheels = files.filter(|file| file.extension().is_some_and(|end| end == "whl"));
        let wheel = wheels.next().context("there is no wheel")?;
        let installed = self.environment("installed", &wheel.display().to_string())?;
        let mut python = Command::new(installed.join("python"));
        run(python.args(["-I", "-c", PROGRAM]).current_dir(&self.out))
    }

    /// Makes a virtual environment `trial/NAME` in which pip installs what `installed` asks for; returns the folder of its
    /// programs.
    fn environment(&self, name: &str, installed: &str) -> Result<PathBuf> {
        let folder = self.out.join("trial").join(name);
        run(Command::new("python3").args(["-m", "venv"]).arg(&folder))?;
        let programs = folder.join(if cfg!(windows) { "Scripts" } else { "bin" });
        let mut pip = Command::new(programs.join("python"));
        run(pip.args(["-m", "pip", "install", "--quiet", installed]))?;
        Ok(programs)
    }

    /// Builds the book of the documentation; says so and does nothing where mdbook is not installed.
    fn book(&self) -> Result<()> {
        if Command::new("mdbook").arg("--version").output().is_err() {
            println!("mdbook is not installed: there is no book");
            return Ok(());
        }
        book::build(&self.out.join("trial/docs"), &self.out.join("book"))
    }
}

impl Package {
    /// Name and version, as `NAME-VERSION`, which cargo calls the packed file.
    fn full_name(&self) -> String {
        format!("{}-{}", self.name, self.version)
    }

    /// Whether the crate has a program, so that its README shows no Rust.
    fn is_program(&self) -> bool {
        self.targets("bin").next().is_some()
    }
}

/// Contents of the first block of a page in Markdown that begins with "```rust".
fn example(page: &str) -> Option<&str> {
    let (_, from) = page.split_once("```rust")?;
    let (_, from) = from.split_once('\n')?;
    from.split("```").next()
}

#[cfg(test)]
mod tests {
    use super::example;

    #[test]
    fn the_first_program_of_a_page_is_found() {
        let page =
            "# A crate\n```sh\nls\n```\n```rust,no_run\nfn main() {}\n```\n```rust\n2\n```\n";
        assert_eq!(example(page), Some("fn main() {}\n"), "{page}");
        assert_eq!(example("# A program\n"), None, "no program");
    }
}
