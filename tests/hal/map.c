/* SPDX-License-Identifier: MIT
 *
 * map - tests the reader of I/O maps: everything that it accepts, and every reason to
 * refuse. Also tests the driver sim, which needs no fake.
 */
#include "hal/sim.h"
#include "tests/hal/bench.h"

static void test_all_options(void)
{
	struct bench b;
	const struct io_point *point;

	bench_begin(&b);
	CHECK(bench_map(&b,
		"# a map\r\n(* with\n comments *)\n\nboard \"Caf\xc3\xa9 $\"1$\"\" # x\n"
		"%IX0.0 gpio line=GPIO17 pull-up active-low debounce=2.5ms\n"
		"I9\tGPIO chip=gpio-0-31 offset=30 (* two *) no-pull\r\n"
		"%QX1.7 gpio line=\"odd name\" safe=1 open-drain\n"
		"%QX2.0 sim safe=HOLD\n"
		"q0 sim # last, without a newline"));
	CHECK_TEXT(b.map.board, "Caf\xc3\xa9 \"1\"");
	CHECK(b.map.count == 5);
	point = b.map.point;
	CHECK_TEXT(point[0].line, "GPIO17");
	CHECK(point[0].bias == BIAS_UP && point[0].active_low &&
	      point[0].debounce_ns == 2500000 && !point[0].output);
	CHECK(point[0].text_line == 6 && point[0].text_column == 1);
	CHECK_TEXT(point[1].chip, "gpio-0-31");
	CHECK(point[1].offset == 30 && point[1].bias == BIAS_NONE &&
	      point[1].addr.byte == 1 && point[1].addr.bit == 1);
	CHECK_TEXT(point[2].line, "odd name");
	CHECK(point[2].output && point[2].safe &&
	      point[2].drive == DRIVE_OPEN_DRAIN);
	CHECK(point[2].has_safe && !point[2].hold && point[3].has_safe && point[3].hold && !point[3].safe);
	CHECK(point[4].driver == DRIVER_sim && point[4].output && !point[4].has_safe);
	bench_end(&b);
}

static bool bad(const char *text, const char *want)
{
	struct bench b;
	bool good;

	bench_begin(&b);
	good = !bench_map(&b, text) &&
	       b.diags.errors > 0;
	diag_print(&b.diags.diag[0], b.text, sizeof(b.text));
	good = good && strstr(b.text, want);
	if (!good)
		printf("# got:  %s\n# want: %s\n", b.text, want);
	bench_end(&b);
	return good;
}
#define BAD(lines, want) CHECK(bad("BOARD \"x\"\n" lines, want))

static void test_refusals(void)
{
	CHECK(bad("", "LD101"));
	CHECK(bad("\xff\xfe@A", "test.io:1:1: error LD142")); /* UTF-16 */
	CHECK(bad("\n# nothing\n", "LD519"));
	CHECK(bad("BOARD\n", "test.io:1:1: error LD519"));
	CHECK(bad("BOARD x\n", "test.io:1:7: error LD519"));
	CHECK(bad("BOARD \"\"\n", "LD519"));
	CHECK(bad("BOARD \"x\" y\n", "test.io:1:11: error LD501"));
	CHECK(bad("%IX0.0 sim\n", "test.io:1:1: error LD519"));
	CHECK(bad("BOARD \"x\"\n\n ab\xff", "test.io:3:4: error LD104"));
	BAD("%IX0.0\n", "test.io:2:1: error LD501");
	BAD("%MX0.0 sim", "LD502");
	BAD("%IW0 gpio line=A", "LD502");
	BAD("%IX8192.0 sim", "LD502");
	BAD("%IX0.8 sim", "LD502");
	BAD("hello sim", "LD502");
	BAD("%IX0.0 modem", "test.io:2:8: error LD503: \"modem\" is not a known driver");
	BAD("%IX0.0 sim fast", "test.io:2:12: error LD504: \"fast\" is not a known option");
	BAD("%IX0.0 gpio line=", "LD505");
	BAD("%IX0.0 gpio line=\"\"", "LD505");
	BAD("%IX0.0 gpio line=a\"b\"", "LD505");
	BAD("%IX0.0 gpio line=A pull-up=1", "LD505");
	BAD("%IX0.0 gpio line=A debounce", "LD505");
	BAD("%IX0.0 gpio line=A debounce=5", "LD505");
	BAD("%IX0.0 gpio line=A debounce=-5ms", "LD505");
	BAD("%IX0.0 gpio line=A debounce=11s", "LD505");
	BAD("%IX0.0 gpio chip=a offset=65536", "LD505");
	BAD("%IX0.0 gpio chip=a offset=99999999999999999999", "LD505");
	BAD("%IX0.0 gpio chip=a offset=x", "LD505");
	BAD("%QX0.0 gpio line=A safe=2", "LD505");
	BAD("%QX0.0 gpio line=A safe=holds", "write it like safe=0, safe=1 or safe=hold");
	BAD("%QX0.0 gpio line=A safe=", "LD505");
	BAD("%IX0.0 sim\nI0 sim", "test.io:3:1: error LD506");
	BAD("%IX0.0 gpio line=A\n%IX0.1 gpio line=A", "LD507: \"A\" is used twice in the map, first for %IX0.0");
	BAD("%IX0.0 gpio chip=A offset=1\n%IX0.1 gpio chip=A offset=1",
	    "LD507");
	BAD("%IX0.0 gpio line=A\n%QX0.1 gpio line=A", "LD518");
	BAD("%IX0.0 gpio line=A safe=1", "LD514");
	BAD("%IX0.0 gpio line=A open-drain", "LD514");
	BAD("%QX0.0 gpio line=A debounce=1ms", "LD527");
	BAD("%IX0.0 gpio", "LD517");
	BAD("%IX0.0 gpio chip=A", "LD517");
	BAD("%IX0.0 gpio offset=1", "LD517");
	BAD("%IX0.0 gpio line=A line=B", "LD526");
	BAD("%IX0.0 gpio line=A chip=B offset=1", "LD520");
	BAD("%IX0.0 gpio line=A pull-up no-pull", "LD520");
	BAD("%QX0.0 gpio line=A open-drain push-pull", "LD520");
	BAD("%QX0.0 gpio line=A active-low active-low", "LD526");
	BAD("%IX0.0 gpio line=\"A\n", "error");
	BAD("%IX0.0 \001 sim", "error");
}

static void test_goes_on(void)
{
	struct bench b;

	bench_begin(&b);
	CHECK(!bench_map(&b, "BOARD \"x\"\n%IX0.0 modem a b c\n"
			 "%IX0.1 gpio what line= offset=z\n%QX0.0 gpio\n"));
	CHECK_AS(b.diags.errors == 5, "every error is reported");
	CHECK(b.diags.diag[4].line == 4);
	bench_end(&b);
}

static void test_hostile(void)
{
	struct bench b;
	size_t len = 1 << 20;
	char *text = malloc(len);
	static const char bytes[] = "a \n%#\"(/=\t1.";

	for (size_t i = 0; text && i < sizeof(bytes); i++) {
		memset(text, bytes[i], len);
		bench_begin(&b);
		CHECK(!iomap_read(&b.map, &b.arena, "test.io", text, len,
				  &b.diags) && b.diags.errors > 0);
		bench_end(&b);
	}
	free(text);
}

static enum diag_id first_of(const char *text, size_t len)
{
	struct bench b;
	enum diag_id out;

	bench_begin(&b);
	out = iomap_read(&b.map, &b.arena, "test.io", text, len, &b.diags) ?
	      DIAG_COUNT : b.diags.diag[0].id;
	bench_end(&b);
	return out;
}

static void test_lengths(void)
{
	char text[LIMIT_NAME + 100];
	char *large = calloc(1, LIMIT_TEXT + 1u);

	for (int more = 0; more < 2; more++) {
		int len = snprintf(text, sizeof(text),
				   "BOARD \"x\"\n%%IX0.0 gpio line=%0*d\n",
				   LIMIT_NAME + more, 0);

		CHECK((first_of(text, (size_t)len) == DIAG_COUNT) == !more);
	}
	CHECK(large && first_of(large, LIMIT_TEXT + 1u) == DIAG_TOO_LARGE);
	free(large);
}

static void test_limit(void)
{
	struct bench b;
	size_t size = 200000, len;
	char *text = malloc(size);

	len = (size_t)snprintf(text, size, "BOARD \"x\"\n");
	for (int i = 0; i < 8 * 512; i++)
		len += (size_t)snprintf(text + len, size - len,
					"%%IX%d.%d sim\n", i / 8, i % 8);
	bench_begin(&b);
	CHECK(iomap_read(&b.map, &b.arena, "test.io", text, len, &b.diags));
	CHECK(b.map.count == LIMIT_IO_POINTS);
	CHECK(hal_open(&b.hal, &b.map, &b.arena, &b.diags));
	CHECK(b.hal.request_count == 64 && b.hal.bytes <= hal_memory(&b.map));
	CHECK(scan(&b, 0));
	bench_end(&b);
	bench_begin(&b);
	snprintf(text + len, size - len, "%%QX0.0 sim\n");
	CHECK(!iomap_read(&b.map, &b.arena, "test.io", text, strlen(text),
			  &b.diags) && b.diags.diag[0].id == DIAG_IO_TOO_MANY);
	bench_end(&b);
	free(text);
}

/* Lines outside the areas of a program are refused with their places. */
static void test_fits(void)
{
	struct bench b;

	bench_begin(&b);
	CHECK(bench_map(&b, "BOARD \"x\"\n%IX511.7 sim\n%QX512.0 sim\n"
			"  %IX8191.7 sim\n%QX2.0 sim\n"));
	CHECK(!iomap_fits(&b.map, &b.program.areas, &b.diags) && b.diags.errors == 2);
	CHECK(b.diags.diag[0].id == DIAG_IO_OUTSIDE && b.diags.diag[0].line == 3);
	CHECK_TEXT(b.diags.diag[1].arg, "%IX8191.7");
	CHECK(b.diags.diag[1].line == 4 && b.diags.diag[1].column == 3);
	diag_init(&b.diags);
	b.program.areas.bytes[AREA_I] = 8192;
	b.program.areas.bytes[AREA_Q] = 513;
	CHECK(areas_place(&b.program.areas));
	CHECK(iomap_fits(&b.map, &b.program.areas, &b.diags) && b.diags.count == 0);
	CHECK(hal_open(&b.hal, &b.map, &b.arena, &b.diags));
	output(&b, 512 * 8, true);
	CHECK(scan(&b, 0));
	bench_end(&b);
	CHECK(refused(&b, "%IX8191.7 sim\n%IX8191.7 sim",
		      "\"%IX8191.7\" is in the map twice, first as %IX8191.7; remove one of the two lines"));
	CHECK(refused_like(&b, "%IX8192.0 sim", "LD502: \"%IX8192.0\" "));
}

static char traced[200];
static void trace(void *context, const struct io_point *point, bool value)
{
	size_t len = strlen(traced);

	(void)context;
	snprintf(traced + len, sizeof(traced) - len, "%d.%d=%d ",
		 (int)point->addr.byte, point->addr.bit, value);
}

/* The driver sim, but nothing of it can be opened or read. */
static bool broken_open(struct request *request, struct trouble *why)
{
	(void)request;
	return trouble_set(why, DIAG_IO_REQUEST, "%s", strerror(EIO));
}

static int broken_read(struct request *request, uint64_t *levels)
{
	(void)request, (void)levels;
	return -EIO;
}

static void test_sim(void)
{
	struct driver driver_broken = driver_sim;
	uint64_t levels;
	struct bench b;
	struct request *in, *out;
	uint32_t bit;

	driver_broken.open = broken_open;
	driver_broken.read = broken_read;
	CHECK(bench_open(&b, "BOARD \"x\"\n%IX0.0 sim pull-up\n%IX0.1 sim\n"
			 "%IX0.2 sim pull-up active-low line=ANY\n"
			 "%QX0.0 sim safe=1\n%QX0.3 sim active-low\n"));
	b.hal.trace = trace;
	scan(&b, 0);
	CHECK_TEXT(traced, "0.0=0 ");
	CHECK_AS(input(&b, 0) && !input(&b, 1) && !input(&b, 2),
		 "an input has the level of its pull");
	in = hal_find(&b.hal, (struct iec_addr){ AREA_I, 1, 1, 0 }, &bit);
	CHECK(in && bit == 1);
	sim_set(in, bit, true);
	sim_set(in, 0, false);
	output(&b, 3, true);
	scan(&b, 1);
	CHECK(!input(&b, 0) && input(&b, 1));
	out = hal_find(&b.hal, (struct iec_addr){ AREA_Q, 1, 3, 0 }, &bit);
	CHECK(out && out->driver->read(out, &levels) == 0 && !(levels >> bit & 1));
	CHECK_TEXT(traced, "0.0=0 0.3=1 ");
	CHECK(!hal_find(&b.hal, (struct iec_addr){ AREA_Q, 1, 4, 0 }, &bit));
	in->driver = &driver_broken;
	for (int i = 2; i < 5; i++)
		scan(&b, i);
	CHECK(hal_quality(&b.hal) == QUALITY_FAULT && input(&b, 1));
	CHECK(!hal_reopen(&b.hal));
	in->driver = &driver_sim;
	CHECK(hal_reopen(&b.hal) && scan(&b, 9) && input(&b, 1));
	traced[0] = 0;
	hal_close(&b.hal);
	CHECK_TEXT(traced, "0.0=1 0.3=0 ");
	bench_end(&b);
}

static void test_no_gpio(void)
{
	struct bench b;

	bench_begin(&b);
	CHECK(bench_map(&b, "BOARD \"x\"\n%IX0.0 gpio line=A\n%QX0.0 sim\n"));
	CHECK(!hal_supported(&b.map, &b.diags) && b.diags.errors == 1);
	CHECK(!hal_open(&b.hal, &b.map, &b.arena, &b.diags));
	diag_print(&b.diags.diag[0], b.text, sizeof(b.text));
	CHECK(strstr(b.text, "test.io:2:1: error LD516"));
	CHECK_TEXT(gpio_version(), "none");
	bench_end(&b);
}

int main(void)
{
	test_all_options();
	test_refusals();
	test_goes_on();
	test_hostile();
	test_lengths();
	test_limit();
	test_fits();
	test_sim();
	test_no_gpio();
	return tap_done();
}
