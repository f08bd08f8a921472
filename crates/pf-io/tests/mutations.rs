//! Sound files, broken at random: every reader answers, none panics, and what is cut short is
//! refused.

#[path = "inputs/sound.rs"]
mod sound;

use pf_grid::Grid;
use pf_io::{
    FileError, GridMap, Unknown, parse_image, parse_movingai, parse_ros, parse_scen, parse_scenario,
};
use proptest::{collection::vec, prelude::*, sample::Index};
use sound::Sound;

/// Hands bytes to the reader of their kind; says whether they were read.
fn read(name: &str, bytes: &[u8]) -> bool {
    let extension = name.rsplit('.').next().unwrap_or("");
    let answer: Result<(), FileError> = match extension {
        "map" => parse_movingai(name, bytes).map(drop),
        "scen" => parse_scen(name, bytes).map(drop),
        "yaml" => parse_ros(name, bytes).and_then(|ros| {
            let picture = b"P2 3 1 255\n0 205 254\n";
            ros.grid("picture.pgm", picture, Unknown::Free).map(drop)
        }),
        "toml" => parse_scenario(name, bytes, &mut |_, _| Ok(hall())).map(drop),
        _ => parse_image(name, bytes).map(drop),
    };
    if let Err(error) = &answer {
        assert!(error.to_string().starts_with(name));
    }
    answer.is_ok()
}

fn hall() -> GridMap {
    GridMap {
        grid: Grid::open(5, 4).expect("a grid").into(),
        frame: None,
        source: "hall.map".into(),
    }
}

#[derive(Clone, Debug)]
enum Mutation {
    Set(Index, u8),
    Flip(Index, u8),
    Insert(Index, Vec<u8>),
    Remove(Index, usize),
    Copy(Index, Index, usize),
    Cut(Index),
}

fn mutation() -> impl Strategy<Value = Mutation> {
    // Bytes that mean something in one format or another come up often.
    let byte = prop_oneof![
        any::<u8>(),
        prop::sample::select(&b"\n\r\t []{}=:-.,\"'#0919PGT@\xff"[..])
    ];
    prop_oneof![
        (any::<Index>(), byte.clone()).prop_map(|(at, byte)| Mutation::Set(at, byte)),
        (any::<Index>(), 0..8u8).prop_map(|(at, bit)| Mutation::Flip(at, bit)),
        (any::<Index>(), vec(byte, 1..12)).prop_map(|(at, bytes)| Mutation::Insert(at, bytes)),
        (any::<Index>(), 1..40usize).prop_map(|(at, n)| Mutation::Remove(at, n)),
        (any::<Index>(), any::<Index>(), 1..40usize)
            .prop_map(|(from, to, n)| Mutation::Copy(from, to, n)),
        any::<Index>().prop_map(Mutation::Cut),
    ]
}

fn mutate(bytes: &mut Vec<u8>, mutation: Mutation) {
    if bytes.is_empty() {
        return;
    }
    let place = |at: Index| at.index(bytes.len());
    match mutation {
        Mutation::Set(at, byte) => {
            let at = place(at);
            bytes[at] = byte;
        }
        Mutation::Flip(at, bit) => {
            let at = place(at);
            bytes[at] ^= 1 << bit;
        }
        Mutation::Insert(at, more) => {
            let at = place(at);
            bytes.splice(at..at, more);
        }
        Mutation::Remove(at, n) => {
            let at = place(at);
            let end = (at + n).min(bytes.len());
            bytes.drain(at..end);
        }
        Mutation::Copy(from, to, n) => {
            let (from, to) = (place(from), place(to));
            let piece = bytes[from..(from + n).min(bytes.len())].to_vec();
            bytes.splice(to..to, piece);
        }
        Mutation::Cut(at) => {
            let at = place(at);
            bytes.truncate(at);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn no_reader_panics(
        sound in prop::sample::select(sound::all()),
        mutations in vec(mutation(), 1..6),
    ) {
        let Sound { name, mut bytes } = sound;
        for mutation in mutations {
            mutate(&mut bytes, mutation);
        }
        read(name, &bytes);
    }

    #[test]
    fn no_reader_panics_on_noise(
        sound in prop::sample::select(sound::all()),
        kept in any::<Index>(),
        noise in vec(any::<u8>(), 0..200),
    ) {
        let mut bytes = sound.bytes[..kept.index(sound.bytes.len())].to_vec();
        bytes.extend(noise);
        read(sound.name, &bytes);
    }
}

#[test]
fn sound_files_are_read() {
    for Sound { name, bytes } in sound::all() {
        assert!(read(name, &bytes), "{name}");
    }
}

#[test]
fn maps_and_pictures_cut_short_are_refused() {
    for Sound { name, bytes } in sound::all() {
        if name.ends_with("toml") || name.ends_with("yaml") || name.ends_with("scen") {
            continue;
        }
        // A text without its last line end is whole.
        let ends = bytes
            .iter()
            .rev()
            .take_while(|b| matches!(b, b'\r' | b'\n'));
        let last = if matches!(name, "a.map" | "b.map" | "plain.pgm") {
            ends.count()
        } else {
            0
        };
        for end in 0..bytes.len() - last {
            assert!(
                !read(name, &bytes[..end]),
                "{name} cut at {end} of {}",
                bytes.len()
            );
        }
    }
}
