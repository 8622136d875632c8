//! A search for equilibrium that is killed between load steps goes on to the same bits.

use crate::common::patches;
use crate::common::sandbox::{Sandbox, signal, until};
use lithosph::output::vtkhdf;

#[test]
fn a_killed_search_for_equilibrium_goes_on_to_the_same_bits() {
    let sandbox = Sandbox::new("resume-quasi-static");
    sandbox.write("patch.toml", &patches::patch(2));
    // Half way the metal yields: what it remembers goes on too.
    let metal = ["--set", "material.rubber.law='j2'", "--set", "material.rubber.yield_stress=0.05"];
    let slow = ["--set", "quasi_static.load_steps=100", "--set", "quasi_static.residual=1e-9", "--set", "output.frames=0.05"];
    let place = ["--backend", "cpu", "--threads", "1"];
    let arguments = |out| [&["run", "patch.toml", "--out", out], &metal[..], &slow, &place].concat();
    assert_eq!(sandbox.lithosph(&arguments("whole")).code, Some(0));
    let folder = sandbox.path("parts");
    let frames = || vtkhdf::read(&folder.join("particles.vtkhdf")).map_or(0, |times| times.len());
    let mut child = sandbox.command(&arguments("parts")).spawn().unwrap();
    until("there are frames", || frames() >= 6 && folder.join("checkpoint.h5").exists());
    signal(&child, libc::SIGKILL);
    assert!(!child.wait().unwrap().success());
    assert!(!folder.join("summary.json").exists(), "the run was over before it was killed");
    let said = sandbox.lithosph(&[&["run", "--resume", "parts"], &place[..]].concat());
    assert_eq!(said.code, Some(0), "{said:?}");
    let bytes = |folder: &str, name: &str| std::fs::read(sandbox.path(folder).join(name)).unwrap();
    for name in ["series.csv", "frames/00000.png", "frames/00019.png", "frames/00020.png"] {
        assert!(bytes("whole", name) == bytes("parts", name), "{name} differs");
    }
    assert_eq!(frames(), 21);
}
