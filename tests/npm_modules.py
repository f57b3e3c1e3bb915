"""Modules of npm that tests need."""
import filecmp
import os
import shutil
import subprocess


class Missing(Exception):
    """The modules are missing, and may not be fetched."""


def fetch(lock_folder, modules, size):
    """Fetches the modules of the lock file into a folder, unless they are there. Raises Missing if that is not allowed."""
    lock = os.path.join(lock_folder, "package-lock.json")
    is_here = os.path.isdir(os.path.join(modules, "node_modules")) and filecmp.cmp(
        os.path.join(modules, "package-lock.json"), lock, shallow=False)
    if is_here:
        return
    if os.environ.get("UNDERSTUDY_HEAVY_HOSTS") != "1":
        raise Missing(f"UNDERSTUDY_HEAVY_HOSTS=1 is not set (it needs npm and {size} of modules)")
    os.makedirs(modules, exist_ok=True)
    for name in ("package.json", "package-lock.json"):
        shutil.copy(os.path.join(lock_folder, name), modules)
    subprocess.run(["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--silent"], cwd=modules, check=True)
