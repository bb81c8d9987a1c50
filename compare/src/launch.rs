//! A fresh process for every measurement: drivers are chosen by the environment, threads by environment and affinity, and no state is carried over.

use crate::backend::Peer;
use crate::cli::Compare;
use crate::draw::Report;
use crate::scene::SceneName;
use anyhow::{Context, Result, ensure};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

/// Processes that are timed in a turn of [`SceneName::ColdStart`].
const COLD_PROCESSES: u32 = 5;

/// A renderer that was found on this machine.
#[derive(Clone, Debug)]
pub(crate) struct Found {
    pub(crate) peer: Peer,
    program: PathBuf,
    /// The Vulkan driver's file.
    driver: Option<PathBuf>,
    /// What the driver came with, if the driver itself does not say its version.
    pub(crate) package: Option<String>,
}

/// Finds a renderer, or says in one line what to install.
pub(crate) fn find(peer: Peer, arguments: &Compare) -> Result<Found, String> {
    let program = std::env::current_exe().map_err(|error| format!("cannot find this program: {error}"))?;
    let driver = match peer {
        Peer::Pineda => return Ok(Found { peer, program, driver: None, package: None }),
        Peer::Euc => {
            let program = arguments.native.as_deref().map_or(program, absolute);
            return Ok(Found { peer, program, driver: None, package: None });
        }
        Peer::Llvmpipe => {
            find_driver(
                None,
                &egl_places(),
                "libegl-mesa0 and libegl1 (Debian: apt-get install libegl-mesa0 libegl1)",
            )?;
            return Ok(Found { peer, program, driver: None, package: None });
        }
        Peer::Embree if cfg!(feature = "embree") => return Ok(Found { peer, program, driver: None, package: None }),
        Peer::Embree => {
            return Err(
                "install libembree-dev (Debian: apt-get install libembree-dev), which `cargo xtask compare` finds"
                    .to_owned(),
            );
        }
        Peer::Lavapipe => find_lavapipe(arguments.lavapipe.as_deref())?,
        Peer::Swiftshader => find_driver(
            arguments.swiftshader.as_deref(),
            &swiftshader_places(),
            "chromium, which contains it (Debian: apt-get install chromium)",
        )?,
    };
    let package = if peer == Peer::Swiftshader { browser_version(&driver) } else { None };
    Ok(Found { peer, program, driver: Some(driver), package })
}

/// Finds lavapipe's driver file, or says in one line what to install.
pub(crate) fn find_lavapipe(named: Option<&Path>) -> Result<PathBuf, String> {
    let install = "mesa-vulkan-drivers (Debian: apt-get install mesa-vulkan-drivers)";
    find_driver(named, &lavapipe_places(), install)
}

/// Lets a process that is to be started know no Vulkan driver but this one.
pub(crate) fn choose_driver(command: &mut Command, driver: &Path) {
    // The second name is the one that loaders before 1.3.207 know.
    command.env("VK_DRIVER_FILES", driver).env("VK_ICD_FILENAMES", driver);
}

/// The version of the browser in whose folder the driver is.
fn browser_version(driver: &Path) -> Option<String> {
    let programs = ["chromium", "chromium-browser", "chrome"].map(|name| driver.with_file_name(name));
    let program = programs.iter().find(|program| program.is_file())?;
    let output = Command::new(program).arg("--version").stderr(Stdio::null()).output().ok()?;
    let said = String::from_utf8(output.stdout).ok()?;
    (!said.trim().is_empty()).then(|| format!("of {}", said.trim()))
}

fn find_driver(named: Option<&Path>, places: &[PathBuf], install: &str) -> Result<PathBuf, String> {
    match named {
        Some(path) if path.is_file() => Ok(absolute(path)),
        Some(path) => Err(format!("there is no {}", path.display())),
        None => places.iter().find(|place| place.is_file()).cloned().ok_or_else(|| format!("install {install}")),
    }
}

/// The processes that draw run in another folder. Only an empty path has no absolute one, and that names no file anyway.
fn absolute(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}

fn lavapipe_places() -> Vec<PathBuf> {
    let arch = std::env::consts::ARCH;
    let names = [format!("lvp_icd.{arch}.json"), "lvp_icd.json".to_owned()];
    let folders = ["/usr/share/vulkan/icd.d", "/usr/local/share/vulkan/icd.d", "/etc/vulkan/icd.d"];
    folders.iter().flat_map(|folder| names.iter().map(move |name| Path::new(folder).join(name))).collect()
}

/// The file that says that Mesa's EGL is there.
fn egl_places() -> Vec<PathBuf> {
    ["/usr/share/glvnd/egl_vendor.d/50_mesa.json", "/etc/glvnd/egl_vendor.d/50_mesa.json"].map(PathBuf::from).into()
}

fn swiftshader_places() -> Vec<PathBuf> {
    ["/usr/lib/chromium", "/usr/lib/chromium-browser", "/usr/lib64/chromium-browser", "/opt/google/chrome"]
        .map(|folder| Path::new(folder).join("vk_swiftshader_icd.json"))
        .into()
}

/// One turn: one renderer draws one scene with so many threads.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn<'a> {
    pub(crate) found: &'a Found,
    pub(crate) scene: SceneName,
    pub(crate) threads: usize,
    pub(crate) cores: usize,
    /// At most this many frames in at most about so many seconds.
    pub(crate) frames: u32,
    pub(crate) seconds: f64,
    pub(crate) picture: Option<&'a Path>,
    /// A folder for what parent and child tell each other.
    pub(crate) scratch: &'a Path,
}

impl Turn<'_> {
    /// Runs the turn and waits for it.
    pub(crate) fn run(&self) -> Result<Report> {
        if self.scene == SceneName::ColdStart { self.run_cold() } else { self.process(self.frames, &[]) }
    }

    /// A few processes that draw one frame each: their times are those of whole processes, and processor time is not told apart.
    fn run_cold(&self) -> Result<Report> {
        let one_frame = |turn: &Self| turn.process(1, &["--warm-up", "0"]);
        // The first brings programs and drivers into the system's memory, and fills drivers' caches of shaders on disk.
        let mut report = one_frame(self)?;
        report.frames_ms.clear();
        for _ in 0..COLD_PROCESSES {
            let start = Instant::now();
            report.peak_mib = one_frame(&Self { picture: None, ..*self })?.peak_mib;
            report.frames_ms.push(1e3 * start.elapsed().as_secs_f64());
        }
        report.cpu_ms = None;
        Ok(report)
    }

    /// One process that draws so many frames at most, and what it reports.
    fn process(&self, frames: u32, arguments: &[&str]) -> Result<Report> {
        let report = self.scratch.join("report.json");
        let mut command = self.pinned();
        command.args(["draw", "--peer", self.found.peer.as_str(), "--scene", self.scene.as_str()]);
        command.args(["--threads", &self.threads.to_string(), "--seconds", &self.seconds.to_string()]);
        command.args(["--frames", &frames.to_string()]).args(arguments).arg("--report").arg(&report);
        if let Some(picture) = self.picture {
            command.arg("--picture").arg(picture);
        }
        self.set_environment(&mut command)?;
        let output = command.stdin(Stdio::null()).stdout(Stdio::null()).output();
        let output = output.with_context(|| format!("cannot start {}", command.get_program().display()))?;
        let said = String::from_utf8_lossy(&output.stderr);
        ensure!(output.status.success(), "{}", said.trim().lines().last().unwrap_or("it ended without a word"));
        Ok(serde_json::from_slice(&std::fs::read(&report)?)?)
    }

    /// The command that keeps to so many cores: of the operating system's making, so that drivers' helper threads keep to them, too.
    fn pinned(&self) -> Command {
        if self.threads >= self.cores {
            return Command::new(&self.found.program);
        }
        let mut command = Command::new("taskset");
        command.arg("-c").arg(format!("0-{}", self.threads - 1)).arg(&self.found.program);
        command
    }

    fn set_environment(&self, command: &mut Command) -> Result<()> {
        command.current_dir(self.scratch);
        if let Some(driver) = &self.found.driver {
            choose_driver(command, driver);
        }
        match self.found.peer {
            Peer::Llvmpipe | Peer::Lavapipe => {
                command.env("LIBGL_ALWAYS_SOFTWARE", "true").env("GALLIUM_DRIVER", "llvmpipe");
                command.env("LP_NUM_THREADS", self.threads.to_string());
                if self.scene == SceneName::ColdStart {
                    command.env("MESA_SHADER_CACHE_DIR", self.scratch.join("mesa"));
                } else {
                    command.env("MESA_SHADER_CACHE_DISABLE", "true");
                }
            }
            Peer::Swiftshader => {
                // Read from the folder in which the process runs.
                let settings = format!("[Processor]\nThreadCount={}\n", self.threads);
                std::fs::write(self.scratch.join("SwiftShader.ini"), settings)?;
            }
            Peer::Pineda | Peer::Euc | Peer::Embree => {}
        }
        Ok(())
    }
}
