//! Wording of notes that several readers give.

/// `1 face`, `2 faces`.
pub(crate) fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

/// That textures are missing, if there are any.
pub(crate) fn textures(count: usize) -> Option<String> {
    (count > 0).then(|| format!("textures are not drawn yet: {} ignored", counted(count, "image", "images")))
}

/// That materials' alpha counts for nothing, if there are any where it should.
pub(crate) fn transparency(materials: usize) -> Option<String> {
    (materials > 0).then(|| {
        let materials = counted(materials, "material", "materials");
        format!("transparency is not drawn yet: {materials} drawn opaque")
    })
}
