#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""installed - the desktop finds what `make install` placed, and the program finds it after the folder was moved."""
import os
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import desk  # noqa: E402
from desk import BUILD, ROOT, Chinese, main, until  # noqa: E402

TOOLS = ('appstreamcli', 'desktop-file-validate', 'glib-compile-schemas', 'update-mime-database', 'update-desktop-database',
         'gio')
PACKAGING = os.path.join(ROOT, 'packaging', 'org.rungboard.Editor.')


def done(*command, **more):
    """The output of a program that must succeed."""
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **more)
    assert result.returncode == 0, '%s\n%s' % (' '.join(command), result.stdout)
    return result.stdout


def install(screen):
    """Installs into a folder and does what a package does afterwards; returns the prefix there."""
    done('make', '-s', '-C', ROOT, '-o', 'all', 'install', 'BUILD=' + BUILD, 'prefix=/usr', 'DESTDIR=' + screen.home)
    share = os.path.join(screen.home, 'usr', 'share')
    done('glib-compile-schemas', '--strict', os.path.join(share, 'glib-2.0', 'schemas'))
    done('update-mime-database', os.path.join(share, 'mime'))
    done('update-desktop-database', os.path.join(share, 'applications'))
    return os.path.join(screen.home, 'usr')


def validators(screen):
    """appstreamcli, desktop-file-validate and the desktop's own tools accept the installed files"""
    done('appstreamcli', 'validate', '--no-net', PACKAGING + 'metainfo.xml')
    done('desktop-file-validate', PACKAGING + 'desktop')
    share = os.path.join(install(screen), 'share')
    door, plain = os.path.join(screen.home, 'door.rung'), os.path.join(screen.home, 'door')
    for path in door, plain:
        with open(path, 'w') as out:
            out.write('RUNGBOARD 1\n' if path == plain else 'nothing of ours\n')
    there = {**os.environ, 'PATH': os.path.join(os.path.dirname(share), 'bin') + ':' + os.environ['PATH'],
             'XDG_DATA_DIRS': share + ':/usr/share', 'XDG_CONFIG_HOME': screen.home}
    for path in door, plain:  # by its name, by its first bytes
        said = done('gio', 'info', '-a', 'standard::content-type', path, env=there)
        assert 'standard::content-type: text/x-rungboard' in said, said
    assert 'org.rungboard.Editor.desktop' in done('gio', 'mime', 'text/x-rungboard', env=there)


def moved(screen):
    """installed, then moved: the language of the session, the samples, I/O maps, the manual and a man page are found"""
    old, new = install(screen), os.path.join(screen.home, 'opt')
    os.rename(old, new)
    desk.EDITOR = os.path.join(new, 'bin', 'ladder-editor')
    shutil.copy('/bin/true', os.path.join(new, 'bin', 'locale'))  # /usr/bin has a program of that name
    share = os.path.join(new, 'share')
    for name in [name for name in os.environ if name.startswith('RUNGBOARD_')]:
        del os.environ[name]
    editor = Chinese(screen, XDG_DATA_DIRS=share + ':/usr/share', GSETTINGS_SCHEMA_DIR='')
    editor.says('An empty sheet. Type a name to make a contact.')
    editor.shot('installed-welcome')
    editor.click(until(lambda: [node for node in editor.all(role='label') if node.name == 'dosing.rung'], 'the sample')[0])
    until(lambda: editor.all(role='table cell'), 'its first rung')
    editor.says('EDIT')
    editor.shot('installed-sheet')
    editor.brought('F1')
    editor.find('Page of the manual', 'text')
    editor.shot('installed-manual')
    assert os.path.exists(os.path.join(share, 'rungboard', 'docs', 'tutorial', 'empty.png'))
    said = done(os.path.join(new, 'bin', 'ladder'), 'check', os.path.join(share, 'rungboard', 'ladders', 'garage-door.rung'))
    assert 'error' not in said, said
    assert os.path.exists(os.path.join(share, 'rungboard', 'ladders', 'boards', 'beaglebone-black.io'))
    with open(os.path.join(share, 'man', 'man1', 'ladder-editor.1')) as page:
        assert '.TH' in page.read()
    editor.finish()


lacks = [tool for tool in TOOLS if not shutil.which(tool)]
if lacks:
    print('1..0 # SKIP needs ' + ', '.join(lacks))
else:
    main([validators, moved])
