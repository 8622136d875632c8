//! Runs the built program in a folder of its own.

use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

/// Two blocks, one of which drifts away: 72 particles and 20 steps, enough for every part of a run.
pub const SCENE: &str = r#"title = "Two blocks"
dimension = 2
units = "dimensionless"
spacing = 1
duration = 4

[[body]]
name = "left"
shape = { block = { min = [0, 0], max = [6, 6] } }
anchor = [0.5, 0.5]
material = "rubber"
velocity = [-0.01, 0]

[[body]]
name = "right"
shape = { block = { min = [7, 0], max = [13, 6] } }
anchor = [0.5, 0.5]
material = "rubber"

[material.rubber]
density = 1
youngs_modulus = 1
poisson_ratio = 0.3

[formulation]
viscosity = { alpha = 1 }

[output]
series = 1
frames = 2
picture = { field = "pressure", width = 320, height = 240 }

[observe.kinetic]
kind = "kinetic_energy"

[observe.momentum]
kind = "momentum"
axis = "x"
body = "left"

[variant.slow]
body = [{ name = "left", velocity = [-0.001, 0] }]
"#;

/// A folder that is gone after the test.
pub struct Sandbox {
    pub folder: PathBuf,
}

/// What a finished program left.
#[derive(Debug)]
pub struct Said {
    /// None where a signal ended it.
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
}

impl Sandbox {
    /// A folder with the scene as `s.toml`; no other test has it, whatever the name.
    pub fn new(name: &str) -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-{}-{count}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        let sandbox = Self { folder };
        sandbox.write("s.toml", SCENE);
        sandbox
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    pub fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).unwrap();
    }

    pub fn exists(&self, name: &str) -> bool {
        self.path(name).exists()
    }

    fn prepare(&self, mut command: Command) -> Command {
        command.current_dir(&self.folder).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command.env_remove("RUST_BACKTRACE").env_remove("XDG_RUNTIME_DIR");
        command
    }

    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = self.prepare(Command::new(env!("CARGO_BIN_EXE_lithosph")));
        command.args(arguments);
        command
    }

    pub fn lithosph(&self, arguments: &[&str]) -> Said {
        said(self.command(arguments).spawn().unwrap())
    }

    /// The same where there is no graphics driver.
    pub fn without_driver(&self, arguments: &[&str]) -> Said {
        let missing = self.path("no-such-driver.json");
        let mut command = self.command(arguments);
        said(command.env("VK_DRIVER_FILES", &missing).env("VK_ICD_FILENAMES", &missing).spawn().unwrap())
    }

    /// The same where no file may grow beyond a size, as on a disk that is full; it takes HDF5 to fill one.
    #[cfg(feature = "hdf5")]
    pub fn on_full_disk(&self, kibibytes: u32, arguments: &[&str]) -> Said {
        let mut command = self.prepare(Command::new("bash"));
        let script = format!("trap '' XFSZ; ulimit -f {kibibytes}; exec \"$0\" \"$@\"");
        said(command.args(["-c", &script, env!("CARGO_BIN_EXE_lithosph")]).args(arguments).spawn().unwrap())
    }
}

impl Drop for Sandbox {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}

/// Waits for the end of a program.
pub fn said(mut child: Child) -> Said {
    let (mut stdout, mut err) = (child.stdout.take().unwrap(), String::new());
    let reader = std::thread::spawn(move || {
        let mut out = String::new();
        stdout.read_to_string(&mut out).unwrap();
        out
    });
    child.stderr.take().unwrap().read_to_string(&mut err).unwrap();
    let code = child.wait().unwrap().code();
    Said { code, out: reader.join().unwrap(), err }
}

/// Waits until something is so, at most a minute.
#[track_caller]
pub fn until(what: &str, holds: impl Fn() -> bool) {
    let begin = Instant::now();
    while !holds() {
        assert!(begin.elapsed() < Duration::from_secs(60), "waited in vain until {what}");
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// Sends a signal to a program that this test started.
pub fn signal(child: &Child, number: i32) {
    // SAFETY: the child is ours and not waited for yet, so that its number belongs to nobody else.
    let sent = unsafe { libc::kill(child.id() as i32, number) };
    assert_eq!(sent, 0);
}
