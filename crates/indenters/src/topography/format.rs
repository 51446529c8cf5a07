//! Detection of the format of a file, by its signature and its extension.

/// Formats of files of heights that are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Format {
    /// Esri's ASCII grid.
    Asc,
    /// Gwyddion Simple Field.
    Gsf,
    /// Array of NumPy.
    Npy,
    /// ISO 25178-71, or the older BCR.
    Sdf,
    /// Digital Surf.
    Sur,
    /// ISO 25178-72.
    X3p,
    /// Text of x, y and z in each line.
    Xyz,
    /// Text of one line of heights for each y.
    Text,
}

/// Signatures of formats that are not supported, with their descriptions for messages.
const UNSUPPORTED_SIGNATURES: [(&[u8], &str); 36] = [
    (
        b"DSCOMPRESSED",
        "a compressed file of Digital Surf; save it uncompressed",
    ),
    (b"\x88\x1b\x03\x6f", "a file of Zygo MetroPro (dat)"),
    (b"\x88\x1b\x03\x70", "a file of Zygo MetroPro (dat)"),
    (b"\x88\x1b\x03\x71", "a file of Zygo MetroPro (dat)"),
    (b"Zygo ", "a text of Zygo"),
    (b"VK3", "a file of a Keyence microscope"),
    (b"VK4", "a file of a Keyence microscope (vk4)"),
    (b"VK6", "a file of a Keyence microscope (vk6)"),
    (b"KPK0", "a file of a Keyence microscope (zon)"),
    (b"\\*File list", "a file of Bruker NanoScope (spm)"),
    (
        b"\\*Force file list",
        "force curves of Bruker NanoScope (spm)",
    ),
    (b"\x01\xb0\x93\xff", "a file of NT-MDT (mdt)"),
    (b"Wyko ASCII", "a text of Wyko Vision (asc)"),
    (b"\x01\x00Directory", "a file of Wyko Vision (opd)"),
    (b"VCA DATA", "a file of Dektak or Bruker Vision (opdx)"),
    (b"AliconaImaging", "a file of Alicona (al3d)"),
    (b"FRTM_GLIDERV", "a file of FRT"),
    (b"WSxM", "a file of WSxM"),
    (b"fileformat = bcrstm", "a file of BCR-STM"),
    (
        b"GWYO",
        "a file of Gwyddion (gwy); export it as Gwyddion Simple Field (gsf)",
    ),
    (
        b"GWYP",
        "a file of Gwyddion (gwy); export it as Gwyddion Simple Field (gsf)",
    ),
    (
        b"Gwyddion XYZ Field",
        "an XYZ field of Gwyddion; export it as text of x, y and z",
    ),
    (b"DSAA", "a grid of Surfer"),
    (b"DSBB", "a grid of Surfer"),
    (b"DSRB", "a grid of Surfer"),
    (b"\x89HDF", "a file of HDF5"),
    (b"CDF", "a file of NetCDF"),
    (b"MATLAB 5.0", "a file of MATLAB"),
    (
        b"\x89PNG",
        "a picture (png), which has colours and no heights",
    ),
    (
        b"\xff\xd8\xff",
        "a picture (jpg), which has colours and no heights",
    ),
    (
        b"II*\0",
        "a picture (tif), of which no unit of heights is known",
    ),
    (
        b"MM\0*",
        "a picture (tif), of which no unit of heights is known",
    ),
    (b"%PDF", "a document (pdf)"),
    (
        b"\xd0\xcf\x11\xe0",
        "a workbook of Excel (xls); save it as CSV",
    ),
    (b"solid ", "a mesh of triangles (stl)"),
    (b"ply\n", "a mesh of triangles (ply)"),
];
/// Number of bytes at the beginning of a file that are examined to tell binary files from texts. Chosen: they hold some rows
/// of every table and the header of every binary format.
const SAMPLED_BYTES: usize = 4096;
/// Number of bytes per control character below which a file counts as binary. Chosen: texts have almost none, and one in eight
/// random bytes is one.
const BYTES_PER_CONTROL: usize = 50;
/// Largest number of control characters with which a damaged short text still counts as text. Chosen: in a text below 300
/// bytes fewer would already exceed one in [`BYTES_PER_CONTROL`].
const MAX_STRAY_CONTROLS: usize = 6;

impl Format {
    /// The format of the contents of a file with an `extension` in lower case.
    ///
    /// # Errors
    /// A description of contents in none of the formats.
    pub(super) fn of(extension: &str, contents: &[u8]) -> Result<Self, String> {
        // Refuse a format that is recognised by its first bytes and not supported, and name it.
        if let Some((_, name)) = UNSUPPORTED_SIGNATURES
            .iter()
            .find(|(start, _)| contents.starts_with(start))
        {
            return Err((*name).to_owned());
        }
        if contents.starts_with(b"PK\x03\x04") && extension != "x3p" {
            return archive_format(contents);
        }
        // Decide the format by the beginning of the contents, which is more reliable than the name.
        let by_contents = [
            (contents.starts_with(b"\x93NUMPY"), Self::Npy),
            (contents.starts_with(b"Gwyddion Simple Field"), Self::Gsf),
            (contents.starts_with(b"DIGITAL SURF"), Self::Sur),
            (is_surface_data(contents), Self::Sdf),
            (is_ascii_grid(contents), Self::Asc),
        ];
        if let Some((_, format)) = by_contents.into_iter().find(|(is_it, _)| *is_it) {
            return Ok(format);
        }
        // If the contents do not decide, decide by the extension of the file name.
        match extension {
            "asc" => Ok(Self::Asc),
            "gsf" => Ok(Self::Gsf),
            "npy" => Ok(Self::Npy),
            "sdf" => Ok(Self::Sdf),
            "sur" => Ok(Self::Sur),
            "x3p" => Ok(Self::X3p),
            _ if is_binary(contents) => Err("a binary file of no known format".to_owned()),
            "xyz" => Ok(Self::Xyz),
            _ => Ok(Self::Text),
        }
    }
}

/// The format of a zip archive, by the names of its parts.
fn archive_format(contents: &[u8]) -> Result<Format, String> {
    let has = |name: &[u8]| contents.windows(name.len()).any(|bytes| bytes == name);
    if has(b"main.xml") {
        return Ok(Format::X3p);
    }
    Err(if has(b".npy") {
        "an archive of arrays of NumPy (npz); write one array with numpy.save".to_owned()
    } else if has(b"xl/workbook") {
        "a workbook of Excel (xlsx); save it as CSV".to_owned()
    } else {
        "an archive (zip)".to_owned()
    })
}

/// Whether contents begin as ISO 25178-71 or the older BCR do, in text or binary.
fn is_surface_data(contents: &[u8]) -> bool {
    let versions = [&b"ISO-1.0"[..], b"ISO-2.0", b"BCR-1.0"];
    let is_known = |start: &u8, version: &[u8]| {
        b"ab".contains(start) && versions.iter().any(|known| version.starts_with(known))
    };
    contents
        .split_first()
        .is_some_and(|(start, version)| is_known(start, version))
}

/// Whether contents begin as Esri's ASCII grid does.
fn is_ascii_grid(contents: &[u8]) -> bool {
    let names = [&b"ncols"[..], b"nrows"];
    let start = contents.trim_ascii_start().get(..5);
    start.is_some_and(|start| names.iter().any(|name| start.eq_ignore_ascii_case(name)))
}

/// Whether the beginning has more control characters than a damaged text; in UTF-16 zeros are parts of letters.
fn is_binary(contents: &[u8]) -> bool {
    let start = &contents[..contents.len().min(SAMPLED_BYTES)];
    let count = |is_it: fn(&u8) -> bool| start.iter().filter(|byte| is_it(byte)).count();
    let zeros = count(|byte| *byte == 0);
    let controls = count(|byte| *byte < 9 || (14..27).contains(byte));
    // In ASCII letters in UTF-16 every other byte is zero.
    let is_wide = zeros.abs_diff(start.len() / 2) <= start.len() / 8;
    let controls = if is_wide { controls - zeros } else { controls };
    controls > MAX_STRAY_CONTROLS && BYTES_PER_CONTROL * controls > start.len()
}
