//! Writing without ever leaving half a file.

use std::fs::{self, File, Permissions};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::Format;
use crate::failure::{Failure, Result};

/// A place to write to that was looked at before the work began.
#[derive(Debug)]
pub struct Target {
    path: PathBuf,
    folder: PathBuf,
    format: Format,
}

impl Target {
    /// Looks at `path`: its format must be known, its folder must exist, and whatever is there must be a plain file.
    pub fn prepare(path: &Path) -> Result<Self> {
        let format = Format::of(path)?;
        // A link stays a link: what it points to is replaced.
        let path = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
        if path.exists() && !path.is_file() {
            return Err(Failure::new(format!("{}: is there already and is not a plain file", path.display())));
        }
        let folder = match path.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent.to_path_buf(),
            _ => PathBuf::from("."),
        };
        if !folder.is_dir() {
            return Err(Failure::new(format!("{}: the folder {} does not exist", path.display(), folder.display())));
        }
        Ok(Self { path, folder, format })
    }

    /// What the file is to hold.
    pub fn format(&self) -> Format {
        self.format
    }

    /// Where the file goes.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Lets `content` write a file beside the target and puts it in the target's place once it is whole. On an error
    /// the target is as it was.
    pub fn write(&self, content: impl FnOnce(&mut BufWriter<&File>) -> Result<()>) -> Result<()> {
        let refused = |error| Failure::of_path(&self.path, &error);
        let file = self.file_beside().map_err(refused)?;
        let mut out = BufWriter::with_capacity(1 << 16, file.as_file());
        content(&mut out).map_err(|failure| failure.in_file(&self.path))?;
        out.flush().map_err(refused)?;
        drop(out);
        file.as_file().sync_all().map_err(refused)?;
        file.persist(&self.path).map_err(|failed| refused(failed.error))?;
        Ok(())
    }

    /// An empty file in the target's folder, with the target's permissions where it exists.
    fn file_beside(&self) -> std::io::Result<NamedTempFile> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(".qsmesh-");
        let permissions = ordinary_permissions();
        if let Some(permissions) = &permissions {
            builder.permissions(permissions.clone());
        }
        let file = builder.tempfile_in(&self.folder)?;
        if let Ok(existing) = fs::metadata(&self.path) {
            // Some file systems know no permissions; the content matters more.
            let _ = file.as_file().set_permissions(existing.permissions());
        }
        Ok(file)
    }
}

/// What a new file gets, less what the user's mask takes away.
#[cfg(unix)]
fn ordinary_permissions() -> Option<Permissions> {
    use std::os::unix::fs::PermissionsExt;
    Some(Permissions::from_mode(0o666))
}

/// What a new file gets.
#[cfg(not(unix))]
fn ordinary_permissions() -> Option<Permissions> {
    None
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::io::Write;

    use super::Target;
    use crate::failure::Failure;

    #[test]
    fn a_failure_leaves_the_old_file_and_no_other() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.off");
        fs::write(&path, "old").unwrap();
        let failed = Target::prepare(&path).unwrap().write(|out| {
            out.write_all(b"half of it")?;
            Err(Failure::new("stop"))
        });
        assert!(failed.unwrap_err().to_string().ends_with("a.off: stop"));
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn permissions_and_links_stay() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = tempfile::tempdir().unwrap();
        let (path, link) = (folder.path().join("a.off"), folder.path().join("link.off"));
        fs::write(&path, "old").unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        symlink(&path, &link).unwrap();
        Target::prepare(&link).unwrap().write(|out| Ok(out.write_all(b"new")?)).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o640);
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    }
}
