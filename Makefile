PY := .venv/bin/python

# the newest that was tested; the default is in constraints.txt
MUJOCO_4 := 4.0.0
# the oldest that reads models/
MUJOCO_OLD := 3.13.0

.PHONY: zoo run test check check-mujoco4 check-mujoco-old numbers scenes gradients reach auto promises fast quadruped trees loop many engines price startup \
	bench regression \
	identify models gallery figures charts chart maps reference site notebooks architecture live check-live film clean

run: .venv/ready
	$(PY) -m mjsim.run --surface all

test: .venv/ready
	$(PY) -m pytest

# what .ci/run runs after `make test`
check: .venv/ready check-mujoco4 check-mujoco-old
	$(PY) -m ruff check .
	$(PY) -m ruff format --check .
	$(PY) -m mypy
	$(PY) -m pytest -m slow

# the bodies walk by MuJoCo 4 as they do by the MuJoCo of constraints.txt
check-mujoco4: .venv/mujoco4/ready
	PYTHONPATH=$(CURDIR)/.venv/mujoco4 $(PY) benchmarks/regression/check.py cable rod planar actuators
	PYTHONPATH=$(CURDIR)/.venv/mujoco4 $(PY) -m pytest tests/mjsim/model/test_bodies.py \
		tests/mjsim/commands/test_export.py tests/mjsim/limbs/test_walks_of_limbs.py

# the files of models/ load and walk in the oldest MuJoCo that reads them
check-mujoco-old: .venv/mujoco-old/ready
	PYTHONPATH=$(CURDIR)/.venv/mujoco-old $(PY) models/check.py

numbers: .venv/ready
	$(PY) benchmarks/convergence.py

scenes: .venv/ready
	$(PY) benchmarks/scenes.py

gradients: .venv/ready
	$(PY) benchmarks/gradients.py

reach: .venv/ready
	$(PY) benchmarks/reach.py

auto: .venv/ready
	$(PY) benchmarks/auto.py check

# whether error bars and what is said of inertia hold on random scenes
promises: .venv/ready
	$(PY) benchmarks/promises.py

# whether fast gaits go as far as at finer links and time steps, or say that they do not
fast: .venv/ready
	$(PY) benchmarks/fast_gaits.py

# the quadruped against its reference on random scenes
quadruped: .venv/ready
	$(PY) benchmarks/quadruped.py

# trees of limbs at random against finer numerics and a finer reference
trees: .venv/ready
	$(PY) benchmarks/trees.py

loop: .venv/ready
	$(PY) benchmarks/loop.py

# walks side by side and alone, and environments
many: .venv/ready
	$(PY) benchmarks/many.py

# speed of engines at a given error of the distance, see docs/benchmark.md
engines: .venv/ready
	$(PY) -m benchmarks.engines

# a prediction beside its walk
price: .venv/ready
	$(PY) benchmarks/price.py

startup: .venv/ready
	$(PY) benchmarks/startup.py

bench: .venv/ready
	$(PY) -m pytest benchmarks --benchmark-only -o addopts="" --benchmark-columns=min,median,rounds

# the numbers that a redesign keeps
regression: .venv/ready
	$(PY) benchmarks/regression/check.py

# the paper's robot, from two of its statements
identify: .venv/ready
	$(PY) -m studies.identification

# write models/ anew after a change of the generator or of the default robot
models: .venv/ready
	$(PY) -m studies.textures models/textures
	$(PY) -m mjsim export --models --out models

# the paper's figures, as docs/figures.md shows them
figures: .venv/ready
	$(PY) -m studies.paper --out docs

# everything that docs/accuracy.md shows; goes on where it was stopped
charts: chart maps

# speed against accuracy: what is not yet in docs/accuracy.csv, and the figures
chart: .venv/ready
	$(PY) -m studies.accuracy

# where methods fail
maps: .venv/ready
	$(PY) -m studies.stability

# robots that others measured beside predictions
zoo: .venv/ready
	$(PY) -m zoo

# the videos and the picture of the README
gallery: .venv/ready
	$(PY) -m studies.gallery

# the API reference, from the docstrings
reference: .venv/ready
	$(PY) scripts/reference.py build/reference

# the site, without a server; the live page is in it where npm is at hand, or where it was made before
SITE_LIVE := $(if $(and $(wildcard site/live),$(shell command -v npm 2>/dev/null)),live)
site: .venv/ready $(SITE_LIVE)
	$(PY) site/build.py build/site

# run the tutorials and the example notebook, and keep what they print and draw
notebooks: .venv/ready
	$(PY) scripts/notebooks.py

# the live page, by npm: build/live/ for a server, build/live/undulator.html opens from a folder; with
# MODELS_AT=github:ORG/REPO/BRANCH it links to MuJoCo's own live viewer
live: build/live-data.json site/live/node_modules/ready
	node site/live/build.mjs build/live-data.json build/live $(MODELS_AT)

# the live page in Debian's Chromium
check-live: live
	node site/live/test/check.mjs build/live build/live-data.json

# the moving picture of the README: four cycles on three grounds
film: live
	rm -rf build/film
	node site/live/test/film.mjs build/live build/film
	$(PY) scripts/film.py build/film docs/live.gif

build/live-data.json: .venv/ready site/live/data.py $(shell find analytic mjsim -name '*.py' -o -name '*.xml')
	$(PY) site/live/data.py $@

site/live/node_modules/ready: site/live/package.json
	@command -v npm > /dev/null || { echo 'the live page needs Node.js with npm'; exit 1; }
	npm install --prefix $(<D) --no-package-lock --no-audit --no-fund --ignore-scripts
	touch $@

architecture: .venv/ready
	$(PY) scripts/architecture.py

.venv/ready: pyproject.toml constraints.txt scripts/setup.sh
	bash scripts/setup.sh
	touch $@

.venv/mujoco4/ready: .venv/ready Makefile
	rm -rf $(@D)
	$(PY) -m pip install --quiet --disable-pip-version-check --no-deps --target $(@D) \
		mujoco==$(MUJOCO_4) mujoco-core==$(MUJOCO_4) mujoco-studio==$(MUJOCO_4)
	touch $@

.venv/mujoco-old/ready: .venv/ready Makefile
	rm -rf $(@D)
	$(PY) -m pip install --quiet --disable-pip-version-check --no-deps --target $(@D) \
		mujoco==$(MUJOCO_OLD)
	touch $@

clean:
	rm -rf .venv build dist site/live/node_modules
