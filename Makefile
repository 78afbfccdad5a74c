# Plain PGXS for everyone who has a server (make, make install, make installcheck), and targets that set
# themselves up on a fresh Debian or Ubuntu machine (make demo, make test, make fuzz). `make help` lists them.

EXTENSION = typify
EXTVERSION := $(shell sed -n "s/^default_version *= *'\(.*\)'.*/\1/p" typify.control)
MODULE_big = typify
CORE_OBJS := $(patsubst %.c,%.o,$(sort $(wildcard src/core/*.c)))
OBJS := $(patsubst %.c,%.o,$(sort $(wildcard src/*.c))) $(CORE_OBJS)

# `make demo DATA=...` is the user's; the DATA of PGXS is the upgrade scripts.
DEMO_DATA := $(DATA)
override DATA = $(wildcard sql/$(EXTENSION)--*--*.sql)
DATA_built = $(EXTENSION)--$(EXTVERSION).sql

REGRESS := $(patsubst tests/sql/%.sql,%,$(sort $(wildcard tests/sql/*.sql)))
REGRESS_OPTS = --inputdir=tests --load-extension=postgis --load-extension=typify

PG_CONFIG ?= pg_config
PGXS := $(shell $(PG_CONFIG) --pgxs 2>/dev/null)

# The server's headers are not ours to warn about. No contracted floats: the result is the same on any machine.
PG_CPPFLAGS = -isystem $(shell $(PG_CONFIG) --includedir-server)
PG_CFLAGS = -std=gnu11 -Wall -Wextra -Wno-declaration-after-statement -ffp-contract=off -MMD -MP
SHLIB_LINK = -lm
# Bitcode helps inlining tiny functions into compiled expressions; ours are not, and it would need clang.
override with_llvm = no
EXTRA_CLEAN = $(OBJS:.o=.d) $(EXTENSION)--*.sql demo-output

all:

ifneq ($(wildcard $(PGXS)),)
include $(PGXS)
else
PGXS_TARGETS = all install uninstall installcheck
.PHONY: $(PGXS_TARGETS) clean
$(PGXS_TARGETS):
	@echo "typify: $(PG_CONFIG) not found or without server headers: install postgresql-server-dev-NN or set PG_CONFIG" >&2
	@exit 1
clean:
	rm -rf $(OBJS) $(MODULE_big).so results regression.diffs regression.out $(EXTRA_CLEAN)
endif

# Nothing of the core is for other libraries to see; the server's side exports what SQL calls.
$(CORE_OBJS): override CFLAGS += -O3 -fvisibility=hidden

-include $(OBJS:.o=.d)

$(DATA_built): $(sort $(wildcard sql/[0-9]*.sql)) typify.control
	cat $(filter %.sql,$^) > $@

clean: clean-tests
.PHONY: clean-tests
clean-tests:
	@for dir in tests/unit tests/fuzz tests/bench; do if [ -f $$dir/Makefile ]; then $(MAKE) -s -C $$dir clean; fi; done

.PHONY: demo web test fuzz bench bench-core quality doc help
# make hands on what it is given: DATA, ROADS, PORT, OSM, ATTRIBUTION, OUT, QGIS, PGVERSION, TYPIFY_DATA, N, RUNS,
# LARGE, TILES, SETS, SCALES, RESULTS_OUT
export DATA
demo: override DATA := $(DEMO_DATA)
demo:
	@tools/demo.sh
web: override DATA := $(DEMO_DATA)
web:
	@tools/web.sh
test:
	@tools/test.sh
fuzz:
	@SECONDS_EACH='$(or $(SECONDS),60)' tools/fuzz.sh
bench:
	@tools/bench.sh
bench-core:
	@tools/bench.sh core
quality:
	@tools/quality.sh
doc:
	@tools/doc.sh

help:
	@echo "make                  build for the server of PG_CONFIG (default: pg_config)"
	@echo "make install          install it there (DESTDIR= stages it)"
	@echo "make installcheck     regression tests in a running server where it is installed"
	@echo "make demo             a settlement typified at four scales, pictures in demo-output/"
	@echo "  DATA=file.csv.gz    ... of your own buildings (columns id, class, geom as hex WKB with SRID)"
	@echo "  ROADS=file.csv.gz   ... with lines under them, ATTRIBUTION='(c) ...' with words below"
	@echo "  OSM=file.osm.pbf    ... of an OpenStreetMap extract"
	@echo "  OUT=folder          ... pictures elsewhere"
	@echo "make web              a web map of it at any scale, until interrupted; PORT=8080 DATA= ROADS="
	@echo "make test             every test, in a throw-away server"
	@echo "  QGIS=1              ... with QGIS, which takes 600 MB more"
	@echo "make fuzz             both fuzz targets, SECONDS=60 each"
	@echo "make bench            ours beside PostGIS's own, a table in doc/benchmarks.md; N=100000 RUNS=5 LARGE=1 OUT=file"
	@echo "make bench-core       the core alone, without a server; N= RUNS= OUT="
	@echo "make quality          figures of layers beside those of PostGIS alone, in doc/quality.md; SETS= SCALES= OUT="
	@echo "make doc              the pictures of README and doc/, and what the tutorial's commands print"
	@echo "make clean            remove what was built"
	@echo "demo, web, test, fuzz, bench, quality and doc install missing Debian packages (as root or sudo), take PGVERSION=15."
