//! Runs one target; see the library of this crate.

#![cfg_attr(fuzzing, no_main)]

/// With libFuzzer.
#[cfg(fuzzing)]
mod guided {
    use std::sync::LazyLock;
    use wavestep_fuzz::{Random, Target};

    static TARGET: LazyLock<(Target, Vec<Vec<u8>>)> = LazyLock::new(|| {
        let name = std::env::var("WAVESTEP_FUZZ").expect("WAVESTEP_FUZZ names a target");
        let target = Target::find(&name).expect("a target");
        (target, target.seeds())
    });

    libfuzzer_sys::fuzz_target!(|data: &[u8]| (TARGET.0.run)(data));

    // Half of the inputs are altered token by token, half as libFuzzer alters bytes.
    libfuzzer_sys::fuzz_mutator!(|data: &mut [u8], size: usize, most: usize, seed: u32| {
        if seed % 2 == 0 {
            return libfuzzer_sys::fuzzer_mutate(data, size, most);
        }
        let (target, seeds) = &*TARGET;
        let other = &seeds[seed as usize / 2 % seeds.len()];
        let altered = target.altered(&data[..size], other, &mut Random(u64::from(seed) << 20 | 1));
        let length = altered.len().min(most);
        data[..length].copy_from_slice(&altered[..length]);
        length
    });
}

#[cfg(not(fuzzing))]
fn main() {
    use std::time::Duration;
    use wavestep_fuzz::{TARGETS, Target};

    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [name, what] = &arguments[..] else {
        panic!("write `TARGET SECONDS`, `TARGET FILE` or `--write FOLDER`");
    };
    if name == "--write" {
        for target in TARGETS {
            let folder = std::path::Path::new(what).join(target.name);
            std::fs::create_dir_all(&folder).expect("a folder");
            for (i, seed) in target.seeds().iter().enumerate() {
                std::fs::write(folder.join(i.to_string()), seed).expect("a file");
            }
        }
        return;
    }
    let target = Target::find(name).unwrap_or_else(|| panic!("there is no target {name}"));
    match what.parse() {
        Ok(seconds) => {
            let seed = std::time::UNIX_EPOCH.elapsed().expect("a clock").as_nanos() as u64 | 1;
            let (count, longest) = target.try_many(usize::MAX, Duration::from_secs(seconds), seed);
            println!("{name}: {count} inputs hold, the longest took {longest:?}");
        }
        Err(_) => target.try_one(&std::fs::read(what).expect("a file")),
    }
}
