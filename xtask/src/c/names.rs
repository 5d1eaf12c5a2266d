//! Names of the libraries, and how the shared one is linked, by operating system.
//!
//! Linux is tested; macOS and Windows follow their documentation.

use std::path::Path;

/// The names of one operating system.
pub(super) struct Names {
    /// The shared library's file.
    pub(super) shared: String,
    /// The name by which programs look for it.
    pub(super) soname: String,
    /// Further names of it: that of programs, and that of linkers.
    pub(super) links: Vec<String>,
    /// The static library, as cargo calls it.
    pub(super) built_static: &'static str,
    /// The static library, installed.
    pub(super) static_: &'static str,
    /// On Windows what programs are linked against.
    pub(super) implib: Option<&'static str>,
    /// The libraries that programs with the static one need.
    pub(super) needs: &'static [&'static str],
    interface: String,
}

impl Names {
    /// The names on this machine, of a version of the library.
    pub(super) fn here(version: &str) -> Self {
        let interface = interface(version);
        if cfg!(target_os = "windows") {
            let gnu = cfg!(target_env = "gnu");
            Self {
                shared: "mediant.dll".to_owned(),
                soname: "mediant.dll".to_owned(),
                links: Vec::new(),
                built_static: if gnu { "libmediant.a" } else { "mediant.lib" },
                // Beside mediant.dll.lib, which programs are linked against.
                static_: if gnu { "libmediant_static.a" } else { "mediant_static.lib" },
                implib: Some(if gnu { "libmediant.dll.a" } else { "mediant.dll.lib" }),
                needs: &["-lkernel32", "-lntdll", "-luserenv", "-lws2_32", "-ldbghelp"],
                interface,
            }
        } else if cfg!(target_os = "macos") {
            let soname = format!("libmediant.{interface}.dylib");
            Self {
                shared: format!("libmediant.{version}.dylib"),
                links: vec![soname.clone(), "libmediant.dylib".to_owned()],
                soname: format!("@rpath/{soname}"),
                built_static: "libmediant.a",
                static_: "libmediant.a",
                implib: None,
                needs: &["-lSystem", "-lm"],
                interface,
            }
        } else {
            let soname = format!("libmediant.so.{interface}");
            Self {
                shared: format!("libmediant.so.{version}"),
                links: vec![soname.clone(), "libmediant.so".to_owned()],
                soname,
                built_static: "libmediant.a",
                static_: "libmediant.a",
                implib: None,
                needs: &["-lpthread", "-lm", "-ldl", "-lrt", "-lutil"],
                interface,
            }
        }
    }

    /// The functions that the shared library exports, and their version.
    pub(super) fn script(&self) -> String {
        if cfg!(target_os = "macos") {
            "_mediant_*\n".to_owned()
        } else {
            format!("MEDIANT_{} {{\n  global: mediant_*;\n  local: *;\n}};\n", self.interface)
        }
    }

    /// Arguments of GCC or clang, which make the shared library of the static one.
    pub(super) fn link(&self, script: &Path, static_: &Path) -> Vec<String> {
        let (script, static_) = (script.display(), static_.display());
        let own = if cfg!(target_os = "macos") {
            vec![
                "-dynamiclib".to_owned(),
                format!("-Wl,-force_load,{static_}"),
                format!("-Wl,-exported_symbols_list,{script}"),
                format!("-Wl,-install_name,{}", self.soname),
                "-Wl,-dead_strip".to_owned(),
            ]
        } else {
            // The unwinder of GCC comes along, so that nothing but the C library is needed at run time.
            let mut own: Vec<String> =
                ["-shared", "-static-libgcc", "-Wl,--whole-archive"].map(str::to_owned).into();
            own.push(static_.to_string());
            let linker = ["--no-whole-archive", "--gc-sections", "--as-needed", "--strip-debug"];
            own.extend(linker.map(|option| format!("-Wl,{option}")));
            own.extend(["relro", "now", "noexecstack", "defs"].map(|option| format!("-Wl,-z,{option}")));
            own.push(format!("-Wl,--version-script={script}"));
            own.push(format!("-Wl,-soname,{}", self.soname));
            own
        };
        own.into_iter().chain(self.needs.iter().map(|&need| need.to_owned())).collect()
    }
}

/// The numbers of a version that stay as long as programs that were compiled against it run: `0.1`, and from
/// 1.0 on the first one.
fn interface(version: &str) -> String {
    let numbers = if version.starts_with("0.") { 2 } else { 1 };
    version.split('.').take(numbers).collect::<Vec<_>>().join(".")
}

#[cfg(test)]
mod tests {
    use super::interface;

    #[test]
    fn interface_before_and_after_the_first_version() {
        assert_eq!([interface("0.1.7"), interface("1.2.3")], ["0.1", "1"]);
    }
}
