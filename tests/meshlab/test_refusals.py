"""A plugin for another MeshLab is never loaded: the build refuses to make it, or the host to take it."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import meshes
from meshlabserver_host import SMOOTH, run

PLUGIN_SOURCE = pathlib.Path(__file__).resolve().parents[2] / 'meshlab-plugin'
# Versions of MeshLab that plugins were built for, in the folder that holds source-VERSION and build-VERSION of each.
WORK = pathlib.Path(os.environ['QSMESH_MESHLAB_WORK'])


def plugin(version):
    return WORK / f'build-{version}' / 'libfilter_qsmesh.so'


def host_library(version):
    """The folder of the library that a plugin was built against."""
    cache = (WORK / f'build-{version}' / 'CMakeCache.txt').read_text()
    return pathlib.Path(cache.split('QSMESH_PLUGIN_FOLDER:INTERNAL=')[1].split('\n')[0]).parent


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)


class Build(Case):
    def assertRefused(self, message, tree, library, *options):
        call = ['cmake', '-S', str(PLUGIN_SOURCE), '-B', str(self.folder / 'build'), f'-DMESHLAB_SOURCE_DIR={tree}',
                f'-DMESHLAB_LIBRARY_DIR={library}', f'-DQSMESH_LIBRARY={os.environ["QSMESH_LIBRARY"]}', *options]
        done = subprocess.run(call, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertNotEqual(done.returncode, 0, done.stdout)
        self.assertIn(message, ' '.join(done.stdout.split()))

    def test_source_tree_of_another_version(self):
        self.assertRefused('do not belong together', WORK / 'source-2022.02', host_library('2025.07'))
        shutil.rmtree(self.folder / 'build')
        self.assertRefused('do not belong together', WORK / 'source-2025.07', host_library('2020.09'))

    def test_version_or_scalar_by_hand(self):
        tree, library = WORK / 'source-2025.07', host_library('2025.07')
        self.assertRefused('MESHLAB_VERSION is no option', tree, library, '-DMESHLAB_VERSION=2025.07d')
        shutil.rmtree(self.folder / 'build')
        self.assertRefused('MESHLAB_SCALAR is no option', tree, library, '-DMESHLAB_SCALAR=float')

    def test_a_folder_that_is_no_source_tree(self):
        self.assertRefused('is no source tree of MeshLab', self.folder, host_library('2025.07'))

    def test_a_folder_without_the_library(self):
        self.assertRefused('no libmeshlab-common in MESHLAB_LIBRARY_DIR', WORK / 'source-2020.09', self.folder)

    def test_a_library_that_does_not_tell_its_version(self):
        source = self.folder / 'empty.cpp'
        source.write_text('')
        subprocess.run(['g++', '-shared', '-o', self.folder / 'libmeshlab-common.so', source], check=True)
        self.assertRefused('does not tell its version', WORK / 'source-2020.09', self.folder)


class Host(Case):
    LOAD = 'import pymeshlab, sys\ntry: pymeshlab.load_plugin(sys.argv[1])\nexcept Exception as error: print(error)'

    def load(self, host, version):
        """What a PyMeshLab answers to a plugin that was built for a version."""
        python = WORK / f'venv-{host}' / 'bin' / 'python'
        done = subprocess.run([python, '-c', self.LOAD, plugin(version)], stdout=subprocess.PIPE, check=True, text=True)
        return done.stdout.strip()

    def test_pymeshlab_takes_its_own_version_only(self):
        versions = {'2022.02': 'different version', '2025.07': 'different version', '2020.09': 'libfilter_qsmesh.so'}
        for host in ('2022.02', '2025.07'):
            for version, complaint in versions.items():
                with self.subTest(host=host, version=version):
                    told = self.load(host, version)
                    self.assertIn('' if host == version else complaint, told)
                    self.assertEqual(told == '', host == version)

    def test_meshlab_2020_goes_on_without_a_plugin_of_another_version(self):
        mesh = self.folder / 'in.ply'
        meshes.write_ply(mesh, *meshes.grid(), 'f')
        root = pathlib.Path(os.environ['QSMESH_MESHLAB_ROOT'])
        other = self.folder / 'root'
        shutil.copytree(root, other, symlinks=True)
        shutil.copy(plugin('2025.07'), other / plugin_place(root))
        status, log, _ = run(self.folder, mesh, (SMOOTH, {}), root=other)
        self.assertIn(f'filter {SMOOTH} not found', log)
        self.assertEqual(status, 255)


def plugin_place(root):
    return next(root.rglob('libfilter_qsmesh.so')).relative_to(root)


if __name__ == '__main__':
    unittest.main()
