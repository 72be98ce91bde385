"""A film of a field over all snapshots: one scale of colours over all times and programs.
SPDX-License-Identifier: BSD-3-Clause"""
import os
import shutil
import subprocess

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg

from . import drawing, reading


def frames(run, field, scale, window, plane, width):
    for n in range(len(run.times)):
        figure = drawing.figure_of(run, field, run.at(n), scale, window, plane, width)
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
        picture = np.asarray(canvas.buffer_rgba())[..., :3]
        yield picture[:picture.shape[0] // 2 * 2, :picture.shape[1] // 2 * 2]  # codecs want even numbers


def write_mp4(to, pictures, fps):
    first = next(pictures)
    size = '%dx%d' % (first.shape[1], first.shape[0])
    command = ['ffmpeg', '-loglevel', 'error', '-y', '-f', 'rawvideo', '-pix_fmt', 'rgb24', '-s', size, '-r', str(fps), '-i', '-',
               '-c:v', 'libx264', '-crf', '20', '-pix_fmt', 'yuv420p', '-movflags', '+faststart', to]
    with subprocess.Popen(command, stdin=subprocess.PIPE) as ffmpeg:
        ffmpeg.stdin.write(first.tobytes())
        for picture in pictures:
            ffmpeg.stdin.write(picture.tobytes())
        ffmpeg.stdin.close()
    if ffmpeg.returncode:
        raise RuntimeError('ffmpeg ended with %d' % ffmpeg.returncode)


def write_apng(to, pictures, fps):
    from PIL import Image
    images = [Image.fromarray(p) for p in pictures]
    some = images[::-(-len(images) // 8)]  # an animated png has one palette
    palette = Image.fromarray(np.concatenate([np.asarray(i) for i in some])).quantize(256)
    images = [i.quantize(palette=palette, dither=0) for i in images]
    images[0].save(to, format='PNG', save_all=True, append_images=images[1:], duration=int(1000 / fps), loop=0)


def movie(run, field=None, fps=None, window=None, scale=None, plane=None, width=800, to=None):
    """Writes the film and returns the file's name: mp4 by ffmpeg, an animated png (.apng, browsers show it) without it.
    fps: by default so many that it lasts five seconds, from 4 to 25; the other words are those of plot."""
    run = reading.read(run) if isinstance(run, (str, os.PathLike)) else run
    field = field or drawing.default_field(run)
    n = len(run.times)
    snapshots = [run.at(k) for k in range(n)]
    scale = scale or drawing.limits(run, field, snapshots)
    if plane != 'space':
        window = window or drawing.window_of(run, drawing.View(run, plane), snapshots)
    fps = fps or min(25, max(4, n // 5))
    to = to or os.path.join(run.dir, field + ('.mp4' if shutil.which('ffmpeg') else '.apng'))
    pictures = frames(run, field, scale, window, plane, width)
    (write_mp4 if to.endswith('.mp4') else write_apng)(to, pictures, fps)
    return to
