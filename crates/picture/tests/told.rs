//! What pictures tell of themselves comes back, and heads that mean ill are errors.

use std::io::{self, Cursor, Read};
use tracer_core::{Image, LayerImage, MatteImage};
use tracer_picture::{Bits, Encoding, Provenance, Setting, ToldError, encode, told_in};

fn provenance() -> Provenance {
    Provenance {
        scene_name: "a b.ron".to_owned(),
        scene_text: "Scene(/* größer */)\n".repeat(40),
        settings: vec![Setting { name: "seed", value: "7".to_owned() }],
        record: r#"{"record":1,"set":["camera=\"oben\""]}"#.to_owned(),
        is_hidden: false,
    }
}

fn file(encoding: Encoding, provenance: &Provenance) -> Vec<u8> {
    let (width, height) = (9, 3);
    let values = vec![0.25; 3 * width as usize * height as usize];
    let (linear, display, mattes) = (values.clone(), values, MatteImage::default());
    let layer = |name, channels: &'static [&'static str]| LayerImage {
        name,
        channels,
        values: vec![0.5; channels.len() * width as usize * height as usize],
    };
    let layers = vec![layer("normal", &["X", "Y", "Z"]), layer("depth", &["Z"])];
    let image = Image { width, height, linear, display, alpha: None, layers, mattes, light_groups: Vec::new() };
    encode(&image, encoding, provenance).expect("a whole picture")
}

const ALL: [Encoding; 5] =
    [Encoding::Png(Bits::Eight), Encoding::Png(Bits::Sixteen), Encoding::Exr, Encoding::Hdr, Encoding::Pfm];

#[test]
fn what_is_written_is_told() {
    let written = provenance();
    for encoding in ALL {
        let told = told_in(file(encoding, &written).as_slice()).expect("a right file");
        assert_eq!((told.encoding, told.width, told.height), (encoding, 9, 3));
        let holds_all = matches!(encoding, Encoding::Png(_) | Encoding::Exr);
        let expected = |text: &str| holds_all.then(|| text.to_owned());
        assert_eq!(told.scene, expected(&written.scene_text), "{encoding:?}");
        assert_eq!(told.record, expected(&written.record), "{encoding:?}");
        let layers: &[&str] = if encoding == Encoding::Exr { &["depth", "normal"] } else { &[] };
        assert_eq!(told.layers, layers);
        if encoding != Encoding::Pfm {
            assert_eq!(told.software.as_deref(), Some(Provenance::SOFTWARE));
            assert_eq!(told.comment.as_deref(), Some("a b.ron: seed 7"));
        }
    }
}

/// Nothing of the scene, the program or the time, so that the same picture is the same bytes.
#[test]
fn hidden_is_hidden() {
    for encoding in ALL {
        let hidden = Provenance { is_hidden: true, ..provenance() };
        let bytes = file(encoding, &hidden);
        assert_eq!(bytes, file(encoding, &Provenance::hidden()), "{encoding:?}");
        let told = told_in(bytes.as_slice()).expect("a right file");
        assert_eq!((told.software, told.comment, told.scene, told.record), (None, None, None, None));
    }
}

/// No cut or changed byte makes it panic, loop or take more memory than the file.
#[test]
fn damaged_heads_are_errors() {
    for encoding in ALL {
        let whole = file(encoding, &provenance());
        for length in 0..whole.len().min(4000) {
            let _ = told_in(&whole[..length]);
        }
        for at in 0..whole.len().min(4000) {
            for change in [0x01, 0x80, 0xff] {
                let mut damaged = whole.clone();
                damaged[at] ^= change;
                let _ = told_in(damaged.as_slice());
            }
        }
    }
    assert!(matches!(told_in(&b"\xff\xd8\xff"[..]), Err(ToldError::Foreign)));
    assert!(matches!(told_in(&b""[..]), Err(ToldError::Foreign)));
}

/// A few kilobytes that unpack to a gigabyte, and heads without an end.
#[test]
fn bombs_are_refused() {
    let bomb = Provenance { scene_text: " ".repeat(Provenance::MAX_SCENE_BYTES), ..provenance() };
    let fine = told_in(file(Encoding::Png(Bits::Eight), &bomb).as_slice()).expect("the longest scene");
    assert_eq!(fine.scene.map(|scene| scene.len()), Some(Provenance::MAX_SCENE_BYTES));
    let mut chunk = png::text_metadata::ITXtChunk::new("Scene", " ".repeat(100 << 20));
    chunk.compressed = true;
    chunk.compress_text().expect("a text");
    let mut info = png::Info::with_size(1, 1);
    info.utf8_text = vec![chunk];
    let mut bytes = Vec::new();
    png::Encoder::with_info(&mut bytes, info)
        .and_then(png::Encoder::write_header)
        .and_then(|mut writer| writer.write_image_data(&[0]))
        .expect("a picture");
    let error = told_in(bytes.as_slice()).expect_err("a bomb");
    assert!(error.to_string().contains("too long"), "{error}");

    let endless = |head: &[u8]| Cursor::new(head.to_vec()).chain(io::repeat(b'a'));
    let chunk = [b"\x89PNG\r\n\x1a\n".as_slice(), &u32::MAX.to_be_bytes(), b"tEXt"].concat();
    let attribute = [b"\x76\x2f\x31\x01\x02\0\0\0scene\0string\0".as_slice(), &u32::MAX.to_le_bytes()].concat();
    for head in [&chunk, &attribute, &b"#?RADIANCE\n".to_vec(), &b"PF\n".to_vec()] {
        assert!(matches!(told_in(endless(head)), Err(ToldError::Broken(_))));
    }
}
