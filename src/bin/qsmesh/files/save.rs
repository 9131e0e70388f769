//! Writing without ever leaving half a file.

use std::fs::{self, File, Permissions};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::failure::{Failure, Result};

/// A place to write to that was looked at before the work began.
#[derive(Debug)]
pub struct Place {
    path: PathBuf,
    folder: PathBuf,
}

/// A whole file beside its place; it goes when this goes.
#[derive(Debug)]
pub struct Staged {
    file: NamedTempFile,
    path: PathBuf,
}

impl Place {
    /// Looks at `path`: its folder must exist, and whatever is there must be a plain file.
    pub fn prepare(path: &Path) -> Result<Self> {
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
        Ok(Self { path, folder })
    }

    /// Where the file goes.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Lets `content` write a file beside the place and puts it there once it is whole. On an error what is there stays
    /// as it was.
    pub fn write(&self, content: impl FnOnce(&mut BufWriter<&File>) -> Result<()>) -> Result<()> {
        self.stage(content)?.put()
    }

    /// Lets `content` write a file beside the place, where it waits.
    pub fn stage(&self, content: impl FnOnce(&mut BufWriter<&File>) -> Result<()>) -> Result<Staged> {
        let refused = |error| Failure::of_path(&self.path, &error);
        let file = self.file_beside().map_err(refused)?;
        let mut out = BufWriter::with_capacity(1 << 16, file.as_file());
        content(&mut out).map_err(|failure| failure.in_file(&self.path))?;
        out.flush().map_err(refused)?;
        drop(out);
        file.as_file().sync_all().map_err(refused)?;
        Ok(Staged { file, path: self.path.clone() })
    }

    /// An empty file in the same folder, with the permissions of what is replaced, if anything is.
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

impl Staged {
    /// Puts the file in its place.
    pub fn put(self) -> Result<()> {
        let Self { file, path } = self;
        file.persist(&path).map_err(|failed| Failure::of_path(&path, &failed.error))?;
        Ok(())
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

    use super::Place;
    use crate::failure::Failure;

    #[test]
    fn a_failure_leaves_the_old_file_and_no_other() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.off");
        fs::write(&path, "old").unwrap();
        let failed = Place::prepare(&path).unwrap().write(|out| {
            out.write_all(b"half of it")?;
            Err(Failure::new("stop"))
        });
        assert!(failed.unwrap_err().to_string().ends_with("a.off: stop"));
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_staged_file_waits_or_goes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.svg");
        let stage = || Place::prepare(&path).unwrap().stage(|out| Ok(out.write_all(b"new")?)).unwrap();
        drop(stage());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
        let staged = stage();
        assert!(!path.exists());
        staged.put().unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
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
        Place::prepare(&link).unwrap().write(|out| Ok(out.write_all(b"new")?)).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o640);
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    }
}
