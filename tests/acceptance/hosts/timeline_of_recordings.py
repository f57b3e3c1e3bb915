#!/usr/bin/env python3
"""Compares the timeline of recordings with their captures and traces: timeline_of_recordings.py UNDERSTUDY [COUNT] [SEED].

It draws COUNT (20) scenarios of all models at random, runs and records each, and asks the recording for its spans and
curves. Every exchange of the capture must be a span once, at its time; every curve must lie within a dot of the trace.
Exits with 1 at the first that is not so, and prints the seed with which it comes again."""
import csv
import json
import pathlib
import random
import re
import socket
import subprocess
import sys
import tempfile

BENCH = """understudy: 1
name: drawn
bench:
  lines:
    l: {{ stations: [ {{ name: d, model: {model}{more} }} ] }}
steps:
{steps}
"""
TICK_NS = 1_000_000
DOTS = 250
AXES = {'simple2-r3': 'AB', 'super-40nc': 'XYZU', 'rs-m8194h': 'XYZU', 'slim': ['m0', 'm1']}


def moves_of_simple2(draw):
    axis = draw.choice('AB')
    yield f'write: {{ d.{axis}axis_SVON: {draw.choice([1, 1, 1, 0])} }}'
    yield (f'write: {{ d.{axis}axis_Pulse: {draw.randint(-9000, 9000)}, d.{axis}axis_Speed: {draw.randint(1, 600)}, '
           f'd.{axis}axis_AccTime: {draw.randint(0, 20)}, d.{axis}axis_DecTime: {draw.randint(0, 20)}, '
           f'd.{axis}axis_Move_INC: 1 }}')


def moves_of_super40(draw):
    contact = 8100 + 100 * draw.randint(0, 3) + draw.choice([3, 4])
    yield f'write: {{ d.M{contact}: {draw.choice([1, 1, 0])} }}'
    yield f'write: {{ d.D{draw.randint(0, 499)}: {draw.randint(-99999, 99999)} }}'


def moves_of_rs(draw):
    axis = draw.choice('XYZU')
    yield f'command: {{ d: RSM_SET_MAX_V {axis} {draw.randint(8000, 90000)} }}'
    yield f'command: {{ d: RSM_SET_V {axis} {draw.randint(1000, 8000)} }}'
    yield f'command: {{ d: RSM_FIXED_MOVE {axis} {draw.randint(-3000, 3000)} }}'


def moves_of_slim(draw):
    yield f'send: {{ text: "{draw.choice(["MA", "MR"])} {draw.randint(-3000, 3000)}" }}'
    yield 'send: { text: "?PE" }'


MOVES = {'simple2-r3': moves_of_simple2, 'super-40nc': moves_of_super40, 'rs-m8194h': moves_of_rs, 'slim': moves_of_slim}


def scenario(draw, model):
    steps = ['send: { text: TX=0 }'] if model == 'slim' else []
    for _ in range(draw.randint(1, 6)):
        steps += MOVES[model](draw)
        steps.append(f'advance: {draw.randint(1, 900)}ms')
        if model != 'slim' and draw.random() < 0.3:
            steps.append('inject: { drop: d, nth: 1 }')
            steps.append('advance: 5ms')
    more = {'simple2-r3': ', address: 1', 'super-40nc': ', port: RS485', 'rs-m8194h': ', address: 1', 'slim': ', modules: 2'}[model]
    return BENCH.format(model=model, more=more, steps='\n'.join(f'  - {step}' for step in steps))


class Recording:
    """Serves a recording, and asks its control socket."""

    def __init__(self, understudy, path, folder):
        control = str(folder / 'c')
        self.process = subprocess.Popen([understudy, 'replay', str(path), '--serve', '--control', control], stdout=subprocess.PIPE, text=True)
        for line in self.process.stdout:
            if line.startswith('the clock'):
                break
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.connect(control)
        self.lines = self.socket.makefile('rw')

    def ask(self, **message):
        self.lines.write(json.dumps(message) + '\n')
        self.lines.flush()
        reply = json.loads(self.lines.readline())
        if not reply['ok']:
            raise AssertionError(f'{message}: {reply}')
        return reply

    def spans(self, end_ns):
        spans, start = [], 0
        while start is not None:
            reply = self.ask(do='spans', from_ns=0, to_ns=end_ns, dots=4000, **{'from': start})
            spans += reply['spans']
            start = reply.get('next')
        return spans

    def close(self):
        self.lines.close()
        self.socket.close()
        self.process.terminate()
        self.process.wait()


def exchanges(capture):
    """What a capture's text has: the time of each request, and of its reply if one was sent."""
    found = []
    for line in capture.splitlines():
        if line.startswith('#'):
            continue
        seconds, way = line.split()[:2]
        at = int(seconds.replace('.', ''))
        if way == 'in':
            found.append((at, None))
        elif found and found[-1][1] is None and 'not sent' not in line:
            found[-1] = (found[-1][0], at)
    return found


def course(rows, name):
    """The moments in ns at which a column of a trace changes, and its values from then on."""
    column = rows[0].index(name)
    return [(round(float(row[0]) * 1e6), float(row[column])) for row in rows[1:]]


def require(is_so, what):
    if not is_so:
        raise AssertionError(what)


def compare_frames(spans, capture):
    wanted = exchanges(capture)
    frames = [span for span in spans if span['kind'] == 'frame']
    told = sum(span.get('count', 1) for span in frames)
    require(told == len(wanted), f'{told} frames in the timeline, {len(wanted)} in the capture')
    times = {at: reply for at, reply in wanted}
    for span in frames:
        require(span['begin_ns'] in times, f'no request of the capture is at {span}')
        if span.get('count', 1) > 1:
            continue
        reply = times[span['begin_ns']]
        require((reply is not None) == ('latency_ns' in span), f'{span}, and its reply in the capture: {reply}')
        if reply is not None:
            require(reply - span['begin_ns'] == span['latency_ns'], f'{span}: the capture has its reply at {reply}')


def compare_curves(recording, rows, end_ns):
    names = [name for name in rows[0] if re.fullmatch(r'd\.[A-Za-z0-9]+\.(position|pulses)', name)]
    require(names, f'the trace has no axis: {rows[0]}')
    reply = recording.ask(do='curves', names=names, from_ns=0, to_ns=end_ns, dots=DOTS)
    dot = end_ns / DOTS
    slack = max(reply['step_ns'], TICK_NS)
    for name, curve in zip(names, reply['curves']):
        changes = course(rows, name)
        for i in range(DOTS):
            begin, end = i * dot - dot - slack, (i + 1) * dot + dot + slack  # within a dot
            before = [value for at, value in changes if at <= begin][-1:]
            near = before + [value for at, value in changes if begin < at <= end]
            low, high = curve['least'][i], curve['greatest'][i]
            require(low is not None and min(near) <= low <= high <= max(near),
                    f'{name}, dot {i}: {low} to {high}; the trace has {min(near)} to {max(near)}')
        require(max(curve['greatest']) == max(value for at, value in changes if at <= end_ns), f'{name}: its greatest value')
        require(min(curve['least']) == min(value for at, value in changes if at <= end_ns), f'{name}: its least value')


def check(understudy, seed):
    draw = random.Random(seed)
    model = draw.choice(sorted(MOVES))
    with tempfile.TemporaryDirectory() as room:
        folder = pathlib.Path(room)
        (folder / 'drawn.yaml').write_text(scenario(draw, model))
        said = subprocess.run([understudy, 'run', 'drawn.yaml', '--record', 'recordings'], cwd=folder, capture_output=True, text=True)
        found = list((folder / 'recordings').rglob('*.jsonl'))
        require(len(found) == 1, f'no recording: {said.stdout}{said.stderr}{(folder / "drawn.yaml").read_text()}')
        subprocess.run([understudy, 'replay', str(found[0]), '--capture', 'day.txt', '--trace', 'day.csv'], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        recording = Recording(understudy, found[0], folder)
        try:
            end_ns = recording.ask(do='timeline')['timeline']['end_ns']
            spans = recording.spans(end_ns)
            compare_frames(spans, (folder / 'day.txt').read_text())
            with open(folder / 'day.csv', newline='') as trace:
                compare_curves(recording, list(csv.reader(trace)), end_ns)
        finally:
            recording.close()
        return model, end_ns, sum(span['kind'] == 'frame' for span in spans)


def main():
    understudy = sys.argv[1]
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    first = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    frames = 0
    for seed in range(first, first + count):
        try:
            model, end_ns, some = check(understudy, seed)
        except (AssertionError, subprocess.CalledProcessError) as error:
            print(f'seed {seed}: {error}', file=sys.stderr)
            return 1
        frames += some
        print(f'seed {seed}: {model}, {end_ns / 1e9:.3f} s, {some} frames', flush=True)
    print(f'{count} recordings, {frames} frames: each is in the timeline once, at its time')
    return 0 if frames > count else 1


if __name__ == '__main__':
    sys.exit(main())
