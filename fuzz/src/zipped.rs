//! 3MF files whose model part is the fuzzer's.

/// A zip file, nothing deflated, of the relationships and a model part.
pub fn zipped(model: &[u8]) -> Vec<u8> {
    const RELATIONSHIPS: &[u8] = br#"<Relationships><Relationship Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel" Target="/a.model"/></Relationships>"#;
    let (mut zip, mut directory) = (Vec::new(), Vec::new());
    for (name, bytes) in [("_rels/.rels", RELATIONSHIPS), ("a.model", model)] {
        let length = (bytes.len() as u32).to_le_bytes();
        // Version 2.0, no flags, stored, no time; sum, lengths; the name's length, and that of nothing else.
        let mut entry = vec![20, 0, 0, 0, 0, 0, 0, 0, 0, 0];
        entry.extend(crc(bytes).to_le_bytes());
        entry.extend(length);
        entry.extend(length);
        entry.extend([name.len() as u8, 0, 0, 0]);
        directory.extend(b"PK\x01\x02\x14\0");
        directory.extend(&entry);
        directory.extend([0; 10]);
        directory.extend((zip.len() as u32).to_le_bytes());
        directory.extend(name.as_bytes());
        zip.extend(b"PK\x03\x04");
        zip.extend(&entry);
        zip.extend(name.as_bytes());
        zip.extend(bytes);
    }
    let start = (zip.len() as u32).to_le_bytes();
    let length = (directory.len() as u32).to_le_bytes();
    zip.extend(directory);
    zip.extend(b"PK\x05\x06\0\0\0\0\x02\0\x02\0");
    zip.extend(length);
    zip.extend(start);
    zip.extend([0, 0]);
    zip
}

/// Zip's sum over bytes (ISO 3309).
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |sum: u32, &byte| {
        (0..8).fold(sum ^ u32::from(byte), |sum, _| if sum & 1 == 1 { sum >> 1 ^ 0xedb8_8320 } else { sum >> 1 })
    })
}
