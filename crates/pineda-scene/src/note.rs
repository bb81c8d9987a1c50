//! Wording of notes that several readers give.

/// `1 face`, `2 faces`.
pub(crate) fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}
