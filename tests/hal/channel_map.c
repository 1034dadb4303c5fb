/* SPDX-License-Identifier: MIT
 *
 * channel_map - tests the reader of an I/O map for all that is more than a level of a chip: what each
 * line becomes, and every reason to refuse one.
 */
#include "hal/channel.h"
#include "tests/hal/bench.h"

static const char *const table_words[] = { "", "coil", "discrete", "input", "holding" };

static void print_value(enum iec_type type, union iec_value value, char *out, size_t size)
{
	iec_value_print(type, value, out, size);
}

/* Only what differs from the usual. */
static void print_point(const struct io_point *point, char *out, size_t size)
{
	const struct io_channel *c = point->channel;
	char text[300];
	size_t len;

	iec_addr_print(point->addr, text, sizeof(text));
	if (!c) {
		snprintf(out, size, "%s %s level", text, driver_row(point->driver)->word);
		return;
	}
	len = (size_t)snprintf(out, size, "%s %s %s", text, driver_row(point->driver)->word,
			       iec_type_row(c->type)->word);
#define SAY(condition, ...) \
	if ((condition) && len < size) \
		len += (size_t)snprintf(out + len, size - len, __VA_ARGS__)
	SAY(c->raw != c->type, " raw=%s", iec_type_row(c->raw)->word);
	SAY(c->device, " %s", c->device);
	SAY(c->name, " %s", c->name);
	SAY(point->driver == DRIVER_pwm, " #%u", (unsigned)c->number);
	SAY(c->period_ns, " period=%lld", (long long)(c->period_ns / 1000000));
	SAY(c->bus >= 0, " bus%d", c->bus);
	SAY(c->unit_id, " unit%u", c->unit_id);
	SAY(c->table, " %s%u", table_words[c->table], c->reg);
	SAY(c->reg_bit >= 0, ".%d", c->reg_bit);
	SAY(c->word_swapped, " words");
	SAY(c->byte_swapped, " bytes");
	iec_addr_print(c->of, text, sizeof(text));
	SAY(c->of_bits, " %s+%u", text, (unsigned)c->of_bits);
	SAY(c->module >= 0, " module%d", c->module);
	SAY(c->scaled, " %g..%g@%g..%g", c->value_low, c->value_high, c->at_low, c->at_high);
	SAY(c->unit, " in%d", c->unit);
	SAY(c->limited, " limits=%g..%g", c->least, c->most);
	SAY(c->switches, " on=%g off=%g", c->on_at, c->off_below);
	SAY(c->filter_ns, " filter=%lld", (long long)(c->filter_ns / 1000000));
	SAY(c->stale_ns != IO_STALE_NS, " stale=%lld", (long long)(c->stale_ns / 1000000));
	SAY(c->poll_ns != IO_POLL_NS, " poll=%lld", (long long)(c->poll_ns / 1000000));
	SAY(c->refresh_ns != IO_REFRESH_NS, " refresh=%lld", (long long)(c->refresh_ns / 1000000));
	print_value(c->type, c->substitute, text, sizeof(text));
	SAY(c->substituted, " substitute=%s", text);
	print_value(c->type, c->safe, text, sizeof(text));
	SAY(point->has_safe && !point->hold, " safe=%s", text);
	SAY(point->hold, " hold");
}

static bool reads(const char *lines, const char *want)
{
	struct bench b;
	char text[4000], got[4000] = "";
	bool good;

	snprintf(text, sizeof(text), "BOARD \"x\"\n"
		 "BUS rs485 modbus-rtu port=/dev/ttyS1\nBUS plant modbus-tcp host=10.0.0.20\n"
		 "BUS yard peer interface=eth0\n%s\n", lines);
	bench_begin(&b);
	good = bench_map(&b, text);
	if (!good)
		diag_print(&b.diags.diag[0], got, sizeof(got));
	for (int i = 0; i < b.map.count; i++) {
		const size_t len = strlen(got);

		if (i)
			snprintf(got + len, sizeof(got) - len, "\n");
		print_point(&b.map.point[i], got + strlen(got), sizeof(got) - strlen(got));
	}
	good = good && strcmp(got, want) == 0;
	if (!good)
		printf("# got:  %s\n# want: %s\n", got, want);
	bench_end(&b);
	return good;
}
#define READS(lines, want) CHECK_AS(reads(lines, want), lines)

static void test_analog(void)
{
	READS("%AIW0 iio device=ads1115 channel=voltage0 range=0..27648 at 0V..10V filter=50ms",
	      "%AIW0 iio INT ads1115 voltage0 0..27648@0..10 in1 filter=50");
	READS("%AIW0 iio device=\"a b\" channel=voltage1", "%AIW0 iio INT a b voltage1 in1");
	READS("%AID0 iio device=a channel=temp as=REAL", "%AID0 iio REAL a temp 0..1@0..1 in3");
	READS("%AIW0 IIO device=a channel=current0 range=-100..100 at 4mA..20mA limits=3.6mA..21mA",
	      "%AIW0 iio INT a current0 -100..100@0.004..0.02 in2 limits=0.0036..0.021");
	READS("%AIW0 iio device=a channel=voltage0 range=0..100 at 0..4095",
	      "%AIW0 iio INT a voltage0 0..100@0..4095");
	READS("%AIW0 iio device=a channel=voltage0 range=0..100 at 10V..0V",
	      "%AIW0 iio INT a voltage0 0..100@10..0 in1");
	READS("%IX3.2 iio device=a channel=voltage0 threshold=10V hysteresis=500mV",
	      "%IX3.2 iio BOOL raw=INT a voltage0 in1 on=10 off=9.5");
	READS("%AQW0 iio device=mcp4725 channel=voltage0 range=0..27648 at 0V..3.3V safe=100",
	      "%AQW0 iio INT mcp4725 voltage0 0..27648@0..3.3 in1 safe=100");
	READS("%AQW0 pwm chip=pwmchip0 channel=0 period=20ms",
	      "%AQW0 pwm INT pwmchip0 #0 period=20 0..27648@0..100 in4");
	READS("%QD4 pwm chip=pwmchip0 channel=3 period=1ms as=REAL safe=hold",
	      "%QD4 pwm REAL pwmchip0 #3 period=1 0..1@0..1 in4 hold");
	READS("%AIW2 w1 sensor=28-000005e2fdc3 stale=5s substitute=-4000",
	      "%AIW2 w1 INT 28-000005e2fdc3 0..100@0..1 in3 stale=5000 substitute=-4000");
	READS("%AIW2 w1 sensor=28-0 range=0..27648 at -40\302\260C..125C poll=2s",
	      "%AIW2 w1 INT 28-0 0..27648@-40..125 in3 poll=2000");
	READS("%AIW4 hwmon device=cpu_thermal channel=temp1 substitute=hold",
	      "%AIW4 hwmon INT cpu_thermal temp1 0..100@0..1 in3");
	READS("%AIW4 hwmon device=ina219 channel=in1", "%AIW4 hwmon INT ina219 in1 0..1000@0..1 in1");
	READS("%AIW4 hwmon device=fans channel=fan1", "%AIW4 hwmon INT fans fan1");
	READS("%AIW0..4 sim", "%AIW0 sim INT\n%AIW2 sim INT\n%AIW4 sim INT");
	READS("%XQX1.0 sim safe=1", "%XQX1.0 sim BOOL safe=1");
}

static void test_modbus(void)
{
	READS("%IW100..106 modbus bus=plant unit=1 input-register=0 poll=100ms stale=1s substitute=0",
	      "%IW100 modbus INT bus1 unit1 input0 substitute=0\n"
	      "%IW102 modbus INT bus1 unit1 input1 substitute=0\n"
	      "%IW104 modbus INT bus1 unit1 input2 substitute=0\n"
	      "%IW106 modbus INT bus1 unit1 input3 substitute=0");
	READS("%IW100..107 modbus bus=plant unit=0 input-register=9",
	      "%IW100 modbus INT bus1 input9\n%IW102 modbus INT bus1 input10\n"
	      "%IW104 modbus INT bus1 input11\n%IW106 modbus INT bus1 input12");
	READS("%QX40.0 modbus bus=plant unit=1 coil=16 on-change refresh=5s",
	      "%QX40.0 modbus BOOL bus1 unit1 coil16 refresh=5000");
	READS("%QX40.6..41.1 modbus bus=rs485 unit=247 coil=65532 safe=hold",
	      "%QX40.6 modbus BOOL bus0 unit247 coil65532 hold\n"
	      "%QX40.7 modbus BOOL bus0 unit247 coil65533 hold\n"
	      "%QX41.0 modbus BOOL bus0 unit247 coil65534 hold\n"
	      "%QX41.1 modbus BOOL bus0 unit247 coil65535 hold");
	READS("%IX4.0..1 modbus bus=rs485 unit=2 discrete-input=7",
	      "%IX4.0 modbus BOOL bus0 unit2 discrete7\n%IX4.1 modbus BOOL bus0 unit2 discrete8");
	READS("%IX4.0..2 modbus bus=rs485 unit=2 holding-register=7 bit=14",
	      "%IX4.0 modbus BOOL raw=WORD bus0 unit2 holding7.14\n"
	      "%IX4.1 modbus BOOL raw=WORD bus0 unit2 holding7.15\n"
	      "%IX4.2 modbus BOOL raw=WORD bus0 unit2 holding8.0");
	READS("%ID8 modbus bus=rs485 unit=2 input-register=7 as=REAL\n"
	      "%ID12 modbus bus=rs485 unit=2 input-register=9 as=REAL word-order=big byte-order=little\n"
	      "DEVICE rs485 unit=2 word-order=little\n"
	      "%ID16 modbus bus=plant unit=2 input-register=7 as=REAL\n"
	      "%ID20 modbus bus=rs485 unit=3 input-register=7 as=REAL\nDEVICE rs485 unit=3 byte-order=little word-order=big",
	      "%ID8 modbus REAL bus0 unit2 input7 words\n%ID12 modbus REAL bus0 unit2 input9 bytes\n"
	      "%ID16 modbus REAL bus1 unit2 input7\n%ID20 modbus REAL bus0 unit3 input7 bytes");
	READS("%ID8..15 modbus bus=rs485 unit=2 input-register=7 as=REAL word-order=little",
	      "%ID8 modbus REAL bus0 unit2 input7 words\n%ID12 modbus REAL bus0 unit2 input9 words");
	READS("%QD8 modbus bus=rs485 unit=2 holding-register=7 as=REAL raw=INT range=0..100 at 0..1000 "
	      "byte-order=little safe=12.5",
	      "%QD8 modbus REAL raw=INT bus0 unit2 holding7 bytes 0..100@0..1000 safe=12.5");
	READS("%ID8 modbus bus=rs485 unit=2 holding-register=7 as=REAL raw=INT",
	      "%ID8 modbus REAL raw=INT bus0 unit2 holding7 0..1@0..1");
	READS("%IL8 modbus bus=rs485 unit=2 holding-register=7 as=ULINT",
	      "%IL8 modbus ULINT bus0 unit2 holding7");
	READS("%XIX30.0 modbus bus=rs485 unit=1 input-register=3 threshold=2000 hysteresis=100",
	      "%XIX30.0 modbus BOOL raw=INT bus0 unit1 input3 on=2000 off=1900");
	READS("%IW0 modbus bus=rs485 unit=1 input-register=3 substitute=65535",
	      "%IW0 modbus INT bus0 unit1 input3 substitute=-1");
	READS("%QW0 modbus bus=rs485 unit=1 holding-register=3\n%IW0 modbus bus=rs485 unit=1 holding-register=3",
	      "%QW0 modbus INT bus0 unit1 holding3\n%IW0 modbus INT bus0 unit1 holding3");
	READS("%ID120 peer from=pump-house name=Level stale=2s",
	      "%ID120 peer DINT pump-house Level bus2 stale=2000");
	READS("%IX120.0 peer bus=yard from=pump-house name=Running",
	      "%IX120.0 peer BOOL pump-house Running bus2");
}

static void test_quality(void)
{
	READS("%IX200.0 quality of=%AIW0..6\n%AIW6 sim\n%IB201 quality of=%IX200.3\n%IX200.3 sim pull-up",
	      "%IX200.0 quality BOOL %AIW0+64\n%AIW6 sim INT\n%IB201 quality USINT %IX200.3+1\n%IX200.3 sim level");
	READS("%IW4 quality of=%XIX0.0..7\n%XIX0.7 sim", "%IW4 quality INT %XIX0.0+8\n%XIX0.7 sim BOOL");
}

static int count_of(const struct iomap *map, enum iec_area area)
{
	int count = 0;

	for (int i = 0; i < map->count; i++)
		count += map->point[i].addr.area == area;
	return count;
}

static void test_modules(void)
{
	struct bench b;
	const struct io_point *last;

	READS("MODULE Card di=2 dq=1 ai=1 aq=1 discrete-input=10 coil=20 input-register=30 holding-register=40\n"
	      "%XIB3..5 module bus=rs485 unit=9 type=card safe=1 stale=3s",
	      "%XIX3.0 module BOOL bus0 unit9 discrete10 module1 stale=3000\n"
	      "%XIX3.1 module BOOL bus0 unit9 discrete11 module1 stale=3000\n"
	      "%XQX2.0 module BOOL bus0 unit9 coil20 module1 stale=3000 safe=1\n"
	      "%XAIW16 module INT bus0 unit9 input30 module1 stale=3000\n"
	      "%XAQW16 module INT bus0 unit9 holding40 module1 stale=3000 safe=1");
	bench_begin(&b);
	CHECK(bench_map(&b, "BOARD \"x\"\nBUS a modbus-rtu port=/dev/ttyS1\n"
			"%XIB0..2 module bus=a unit=1 type=DIO1000\n%XIB45 module bus=a unit=2 type=DUT6000\n"));
	CHECK(b.map.count == 24 + 12 + 4 + 9 + 8 && count_of(&b.map, AREA_XI) == 28 &&
	      count_of(&b.map, AREA_XQ) == 21 && count_of(&b.map, AREA_XAI) == 8);
	last = &b.map.point[b.map.count - 1];
	CHECK(last->addr.area == AREA_XAI && last->addr.byte == 16 * 15 + 14 && last->channel->reg == 7);
	CHECK(last->text_line == 4 && last->channel->module == 15 && io_is_gateway(last));
	bench_end(&b);
}

static void test_net(void)
{
	struct bench b;
	const struct io_net *net;

	bench_begin(&b);
	CHECK(bench_map(&b, "BOARD \"x\"\n"
		"BUS rs485 modbus-rtu port=/dev/ttyS1 baud=115200 parity=none stop-bits=2 timeout=50ms\n"
		"BUS plant modbus-tcp host=[fe80::1]:1502\n"
		"bus yard peer interface=eth0 group=239.1.2.3:4000\n"
		"SERVE plc modbus-tcp listen=127.0.0.1:1502 connections=2 rate=50\n"
		"SERVE old modbus-rtu port=/dev/ttyS2 unit=7\n"
		"WINDOW plc coil=0..15 %QX0.0 read-only\n"
		"WINDOW plc holding-register=5 %MW10 read-write # one\n"
		"PUBLISH pump-house Level, Running,Tank.Level every=250ms\n"));
	net = b.map.net;
	CHECK(net && net->bus_count == 3 && net->serve_count == 2 && net->window_count == 2 &&
	      net->publish_count == 1);
	CHECK(net->bus[0].baud == 115200 && net->bus[0].parity == 'N' && net->bus[0].stop_bits == 2 &&
	      net->bus[0].timeout_ns == 50 * MS);
	CHECK_TEXT(net->bus[0].port, "/dev/ttyS1");
	CHECK_TEXT(net->bus[1].host, "fe80::1");
	CHECK(net->bus[1].tcp_port == 1502 && net->bus[1].timeout_ns == 300 * MS);
	CHECK_TEXT(net->bus[2].host, "239.1.2.3");
	CHECK_TEXT(net->bus[2].interface, "eth0");
	CHECK(net->bus[2].tcp_port == 4000 && net->bus[2].kind == BUS_PEER);
	CHECK_TEXT(net->serve[0].at.host, "127.0.0.1");
	CHECK(net->serve[0].connections == 2 && net->serve[0].rate == 50 && !net->serve[0].unit_id);
	CHECK(net->serve[1].unit_id == 7 && net->serve[1].at.baud == 19200 && net->serve[1].at.parity == 'E');
	CHECK(net->window[0].count == 16 && !net->window[0].writable && net->window[0].serve == 0 &&
	      net->window[0].table == TABLE_COIL && net->window[0].addr.area == AREA_Q);
	CHECK(net->window[1].first == 5 && net->window[1].count == 1 && net->window[1].writable &&
	      net->window[1].addr.byte == 10);
	CHECK_TEXT(net->publish[0].as, "pump-house");
	CHECK(net->publish[0].count == 3 && net->publish[0].every_ns == 250 * MS && net->publish[0].bus == 2);
	CHECK_TEXT(net->publish[0].name[1], "Running");
	CHECK_TEXT(net->publish[0].name[2], "Tank.Level");
	bench_end(&b);
	bench_begin(&b);
	CHECK(bench_map(&b, "BOARD \"x\"\n%IX0.0 sim\n") && !b.map.net);
	bench_end(&b);
}

static bool bad(const char *lines, const char *want)
{
	struct bench b;
	char text[3000];
	bool good;

	snprintf(text, sizeof(text), "BOARD \"x\"\nBUS a modbus-rtu port=/dev/ttyS1\n"
		 "BUS p peer interface=lo\nSERVE s modbus-tcp listen=127.0.0.1\n%s\n", lines);
	bench_begin(&b);
	good = !bench_map(&b, text) && b.diags.errors > 0;
	diag_print(&b.diags.diag[0], b.text, sizeof(b.text));
	good = good && strstr(b.text, want);
	if (!good)
		printf("# got:  %s\n# want: %s\n", b.text, want);
	bench_end(&b);
	return good;
}
#define BAD(lines, want) CHECK_AS(bad(lines, want), lines)
#define MB "%IW0 modbus bus=a unit=1 input-register=0 "
#define IIO "%AIW0 iio device=d channel=voltage0 "

static void test_bad_points(void)
{
	BAD("%MW0 iio device=d channel=voltage0", "test.io:5:1: error LD502");
	BAD("%AIW0 gpio line=A", "test.io:5:1: error LD502");
	BAD("%AIW99999 sim", "LD502");
	BAD("%AIW0", "LD501");
	BAD(IIO "fast", "test.io:5:37: error LD528: \"fast\" is not an option of iio");
	BAD(IIO "line=GPIO17", "LD528");
	BAD(IIO "pull-up", "LD528");
	BAD("%AIW0 iio device=d", "test.io:5:1: error LD529: \"%AIW0\" also needs channel=");
	BAD("%AQW0 pwm chip=c period=20ms", "LD529");
	BAD("%AQW0 pwm chip=c channel=0", "LD529");
	BAD("%AIW0 w1", "LD529: \"%AIW0\" also needs sensor=");
	BAD("%IW0 modbus bus=a input-register=0", "LD529");
	BAD("%IW0 modbus bus=a unit=1", "LD529: \"%IW0\" also needs holding-register= (or coil= …)");
	BAD("%IW0 modbus", "LD529: \"%IW0\" also needs bus=, unit=, holding-register= (or coil= …)");
	BAD("%IW0 peer from=b", "LD529");
	BAD("%XIB0 module bus=a unit=1", "LD529");
	BAD("%IW0 modbus bus=b unit=1 coil=0", "test.io:5:13: error LD530: \"bus=b\": no BUS above");
	BAD("%IW0 modbus bus=p unit=1 input-register=0", "LD531");
	BAD("%IW0 peer bus=a from=b name=c", "LD531");
	BAD("%IW0 modbus bus=a unit=1 coil=0", "LD532: \"%IW0\" has another width: here it must be BOOL (%IX0.0)");
	BAD("%IX0.0 modbus bus=a unit=1 input-register=0", "LD532: \"%IX0.0\" has another width: here it must be WORD (%IW0)");
	BAD("%IB0 modbus bus=a unit=1 input-register=0", "LD532");
	BAD("%IX0.0 iio device=d channel=voltage0", "LD532");
	BAD(IIO "threshold=1V", "LD532");
	BAD(IIO "as=REAL", "LD532: \"%AIW0\" has another width: here it must be REAL (%AID0)");
	BAD("%IX0.5 peer from=b name=c as=INT", "LD532: \"%IX0.5\" has another width: here it must be INT (%IW0)");
	BAD("%IW4 peer from=b name=c as=BOOL", "must be BOOL (%IX4.0)");
	BAD(MB "as=BOOL", "LD532");
	BAD(MB "as=STRING", "LD505");
	BAD(MB "as=TIME", "LD505");
	BAD(MB "raw=BYTE", "LD505");
	BAD(IIO "range=10..0 at 0V..10V", "test.io:5:37: error LD533: \"range=10..0\": the second");
	BAD(IIO "range=0..10 at 5V..5V", "LD533");
	BAD(IIO "limits=5V..1V", "test.io:5:37: error LD533");
	BAD(IIO "range=0..10V", "LD505");
	BAD(IIO "range=0", "LD505");
	BAD(IIO "range=0..10 at", "LD505");
	BAD(IIO "range=0..10 at 0V", "LD505");
	BAD(IIO "range=0..10 at 0V..10", "LD505");
	BAD(IIO "range=0..10 at 0V..10mA", "LD505");
	BAD(IIO "range=0..10 at 0X..10X", "LD505");
	BAD(IIO "range=0..10 at 0A..10A", "LD536: \"0A..10A\": the device measures in V");
	BAD(IIO "limits=0%..10%", "LD536");
	BAD(MB "range=0..10 at 0V..10V", "LD505: \"0V..10V\" is not understood; write it like 0..4095");
	BAD(IIO "range=a..b", "LD505");
	BAD(IIO "range=0..1e400", "LD505");
	BAD("%IX0.0 iio device=d channel=voltage0 threshold=1A", "LD536");
	BAD("%IX0.0 iio device=d channel=voltage0 threshold=1V hysteresis=-1V", "LD505");
	BAD(IIO "filter=0ms", "LD505");
	BAD(IIO "filter=2h", "LD505");
	BAD(IIO "stale", "LD505");
	BAD(IIO "stale=1s stale=1s", "LD526");
	BAD(IIO "substitute=99999", "LD505");
	BAD(IIO "substitute=x", "LD505");
	BAD(IIO "safe=1", "test.io:5:37: error LD514");
	BAD("%AQW0 iio device=d channel=voltage0 stale=1s", "LD527");
	BAD("%AQW0 iio device=d channel=voltage0 safe=1.5", "LD505");
	BAD("%AQW0 w1 sensor=a", "test.io:5:7: error LD527");
	BAD("%AQW0 hwmon device=a channel=temp1", "LD527");
	BAD("%QW0 peer from=b name=c", "LD527");
	BAD("%AIW0 pwm chip=c channel=0 period=1ms", "LD514");
	BAD("%QX0.0 modbus bus=a unit=1 discrete-input=0", "LD527");
	BAD("%QW0 modbus bus=a unit=1 input-register=0", "LD527");
	BAD("%IX0.0 modbus bus=a unit=1 coil=0 discrete-input=0", "LD520");
	BAD("%IX0.0 modbus bus=a unit=248 coil=0", "LD505");
	BAD("%IX0.0 modbus bus=a unit=1 coil=65536", "LD505");
	BAD("%IX0.0 modbus bus=a unit=1 coil=-1", "LD505");
	BAD("%IX0.0 modbus bus=a unit=1 holding-register=1 bit=16", "LD505");
	BAD("%QX0.0 modbus bus=a unit=1 coil=1 on-change=1", "LD505");
	BAD("%QX0.0 modbus bus=a unit=1 coil=1 word-order=middle", "LD505");
	BAD("%IX0.0 quality", "LD529");
	BAD("%IX0.0 quality of=", "LD505");
	BAD("%IX0.0 quality of=%QX0.0", "LD505");
	BAD("%IX0.0 quality of=%AIW6..2", "LD505");
	BAD("%IX0.0 quality of=Level", "LD505");
	BAD("%QX0.0 quality of=%AIW0", "LD527");
	BAD("%IX0.0 quality of=%AIW0\n%AIW2 sim", "test.io:5:1: error LD546: \"%AIW0\": no line");
	BAD("%IX0.0 quality of=%IX0.0", "LD546");
}

static void test_bad_groups(void)
{
	BAD("%IW100..98 modbus bus=a unit=1 input-register=0", "LD534");
	BAD("%IW100.. modbus bus=a unit=1 input-register=0", "LD534");
	BAD("%IW100..x sim", "LD534");
	BAD("%IX0.0..8 sim", "LD534");
	BAD("%IX0.0..1.8 sim", "LD534");
	BAD("%IX0.3..2 sim", "LD534");
	BAD("%IW100..9999999 sim", "LD534");
	BAD("%IW0..4 modbus bus=a unit=1 input-register=65534", "LD871: \"%IW0..4\": the numbers of coils and registers end at 65535");
	BAD("%IX0.0..7 modbus bus=a unit=1 coil=65530", "LD871");
	BAD("%AIW0..2 iio device=d channel=voltage0", "LD535");
	BAD("%IW0..2 peer from=a name=b", "LD535");
	BAD("%IX0.0..511.7 sim\n%QX0.0..511.7 sim\n%XIX0.0 sim", "LD524");
	BAD("%AIW0 sim\n%AIB1 sim", "test.io:6:1: error LD506: \"%AIB1\" is in the map twice, first as %AIW0; remove");
	BAD("%IX1.3 sim\n%IW0 sim", "test.io:6:1: error LD506: \"%IW0\" is in the map twice, first as %IX1.3");
	BAD("%IW0..2 sim\n%IX2.0 gpio line=A", "LD506");
	BAD("%QX0.0 modbus bus=a unit=1 coil=5\n%QX0.1 modbus bus=a unit=1 coil=5",
	    "test.io:6:1: error LD507: \"unit 1 coil 5\" is used twice in the map, first for %QX0.0");
	BAD("%QD0 modbus bus=a unit=1 holding-register=5\n%QW4 modbus bus=a unit=1 holding-register=6", "LD507");
	BAD("%AQW0 pwm chip=c channel=0 period=1ms\n%AQW2 pwm chip=c channel=0 period=1ms", "LD507");
	BAD("%AQW0 iio device=c channel=voltage0\n%AQW2 iio device=c channel=voltage0", "LD507");
}

static void test_bad_modules(void)
{
	BAD("%XIB0 module bus=a unit=1 type=DIO2000", "LD537");
	BAD("%XIB1 module bus=a unit=1 type=DIO1000", "LD538");
	BAD("%XIB0..3 module bus=a unit=1 type=DIO1000", "LD538");
	BAD("%XIB48 module bus=a unit=1 type=DIO1000", "LD538");
	BAD("%IB0 module bus=a unit=1 type=DIO1000", "LD538");
	BAD("%XIX0.0 module bus=a unit=1 type=DIO1000", "LD538");
	BAD("%XIB0 module bus=a unit=1 type=DIO1000\n%XIB0 module bus=a unit=2 type=DIO1000", "LD506");
	BAD("%XIB0 module bus=a unit=1 type=DIO1000\n%XIB3 module bus=a unit=1 type=DIO1000", "LD507");
	BAD("MODULE", "LD505");
	BAD("MODULE Card di", "LD505");
	BAD("MODULE Card di=25", "LD505");
	BAD("MODULE Card cards=2", "LD505");
	BAD("MODULE DUT4000 di=2", "LD539");
	BAD("MODULE A di=2\nMODULE a di=2", "test.io:6:8: error LD539");
}

static void test_bad_nets(void)
{
	BAD("BUS", "LD505");
	BAD("BUS b", "LD505");
	BAD("BUS b modbus", "test.io:5:1: error LD505");
	BAD("BUS b modbus-rtu", "LD542: \"b\" needs port=/dev/ttyS1");
	BAD("BUS b modbus-tcp", "LD542");
	BAD("BUS b peer", "LD542");
	BAD("SERVE t modbus-tcp", "LD542: \"t\" needs listen=");
	BAD("SERVE t modbus-rtu port=/dev/ttyS9", "LD542: \"t\" needs unit=1");
	BAD("SERVE t peer interface=lo", "LD505");
	BAD("BUS a modbus-tcp host=h", "test.io:5:5: error LD539");
	BAD("BUS s modbus-tcp host=h", "LD539");
	BAD("BUS b modbus-rtu port=/dev/ttyS1", "LD540: \"b\" uses the serial line of \"a\"");
	BAD("SERVE b modbus-rtu port=/dev/ttyS1 unit=1", "LD540");
	BAD("BUS b modbus-rtu port=ttyS2", "LD505");
	BAD("BUS b modbus-rtu port=/dev/ttyS2 baud=19201", "LD505");
	BAD("BUS b modbus-rtu port=/dev/ttyS2 parity=mark", "LD505");
	BAD("BUS b modbus-rtu port=/dev/ttyS2 stop-bits=3", "LD505");
	BAD("BUS b modbus-rtu port=/dev/ttyS2 timeout=1", "LD505");
	BAD("BUS b modbus-rtu port=/dev/ttyS2 baud=9600 baud=9600", "LD526");
	BAD("BUS b modbus-rtu port=/dev/ttyS2 host=h", "LD541: \"host=h\" is not an option of modbus-rtu");
	BAD("BUS b modbus-tcp host=h connections=2", "LD541");
	BAD("BUS b modbus-tcp host=h:0", "LD505");
	BAD("BUS b modbus-tcp host=h:70000", "LD505");
	BAD("BUS b modbus-tcp host=[::1", "LD505");
	BAD("BUS b modbus-tcp host=[::1]x", "LD505");
	BAD("BUS b modbus-tcp host=", "LD505");
	BAD("SERVE t modbus-tcp listen=h:1602\nSERVE u modbus-tcp listen=h:1602",
	    "test.io:6:7: error LD870: \"u\" listens at the address and port of \"t\"");
	BAD("SERVE t modbus-tcp listen=0.0.0.0:1602\nSERVE u modbus-tcp listen=h:1602", "LD870");
	BAD("SERVE t modbus-tcp listen=h:1602\nSERVE u modbus-tcp listen=[::]:1602", "LD870");
	BAD("SERVE t modbus-tcp listen=h unit=0", "LD505");
	BAD("SERVE t modbus-tcp listen=h connections=0", "LD505");
	BAD("SERVE t modbus-tcp listen=h rate=0", "LD505");
	BAD("MODULE m di=4 di2=1 ai=9", "test.io:5:15: error LD505: \"di2=1\" is not understood; write it like di=24");
	BAD("MODULE m di=4 ai=9", "test.io:5:15: error LD505: \"ai=9\"");
	BAD("WINDOW", "LD505");
	BAD("WINDOW a coil=0 %QX0.0 read-only", "test.io:5:8: error LD530: \"a\": no SERVE above");
	BAD("WINDOW s coil=0 %QX0.0", "LD505");
	BAD("WINDOW s coil=0 %QX0.0 write", "LD505");
	BAD("WINDOW s coil=0 %QW0 read-only", "LD505");
	BAD("WINDOW s holding-register=0 %QX0.0 read-only", "LD505");
	BAD("WINDOW s coil=9..3 %QX0.0 read-only", "LD505");
	BAD("WINDOW s coils=0 %QX0.0 read-only", "LD505");
	BAD("WINDOW s coil=0 %IX0.0 read-write", "LD543");
	BAD("WINDOW s input-register=0 %MW0 read-write", "LD543");
	BAD("WINDOW s coil=0..9 %MX0.0 read-only\nWINDOW s coil=9 %QX0.0 read-only", "test.io:6:1: error LD544");
	BAD("%IW9 modbus bus=a unit=1 holding-register=0 ask=", "LD505");
	BAD("%IW9 modbus bus=a unit=1 holding-register=0 ask=M poll=1s", "LD520: \"M\"");
	BAD("%IW9 modbus bus=a unit=1 holding-register=0 ask=M stale=1s", "LD520");
	BAD("%QW9 modbus bus=a unit=1 holding-register=0 ask=M safe=0", "LD520");
	BAD("%QW9 modbus bus=a unit=1 holding-register=0 ask=M refresh=1s", "LD520");
	BAD("%QW9 modbus bus=a unit=1 holding-register=0 ask=M on-change", "LD520");
	BAD("%IW9 modbus bus=a unit=1 holding-register=0 ask=M ask=M", "LD526");
	BAD("%IW9 sim ask=M", "LD528");
	BAD("%IW9 modbus bus=a unit=1 holding-register=0 ask=M\n%QW9 modbus bus=a unit=1 holding-register=0 ask=m", "test.io:6:");
	BAD("%IW9 modbus bus=a unit=1 holding-register=0 ask=M\n%QW9 modbus bus=a unit=1 holding-register=0 ask=m", "LD547");
	BAD("BUS q modbus-tcp host=h\n%IW9 modbus bus=a unit=1 holding-register=0 ask=M\n%IW6 modbus bus=q unit=1 holding-register=0 ask=M", "LD547");
}

static void test_bad_devices(void)
{
	BAD("DEVICE", "LD505");
	BAD("DEVICE a", "LD505");
	BAD("DEVICE a read-registers=5", "LD505");
	BAD("DEVICE z unit=1 gap=0", "test.io:5:8: error LD530");
	BAD("DEVICE a unit=248", "LD505");
	BAD("DEVICE a unit=1 read-registers=0", "LD505");
	BAD("DEVICE a unit=1 read-registers=126", "LD505");
	BAD("DEVICE a unit=1 write-registers=124", "LD505");
	BAD("DEVICE a unit=1 read-coils=2001", "LD505");
	BAD("DEVICE a unit=1 write-coils=1969", "LD505");
	BAD("DEVICE a unit=1 gap=125", "LD505");
	BAD("DEVICE a unit=1 gap", "LD505");
	BAD("DEVICE a unit=1 together=1", "LD505");
	BAD("DEVICE a unit=1 registers=4", "LD505");
	BAD("DEVICE a unit=1 gap=0 gap=0", "LD526");
	BAD("DEVICE a unit=1 word-order", "LD505: \"word-order\" is not understood; write it like word-order=big or word-order=little");
	BAD("DEVICE a unit=1 byte-order=middle", "like byte-order=big or byte-order=little");
	BAD("DEVICE a unit=1 word-order=big word-order=little", "LD526");
	BAD("DEVICE a unit=1 word-order=big byte-order=big byte-order=big", "LD526");
	BAD("DEVICE a unit=1 gap=0\nDEVICE a unit=1 together", "test.io:6:1: error LD539");
	BAD("BUS q peer interface=lo\nDEVICE q unit=1", "LD530");
	BAD("PUBLISH", "LD505");
	BAD("PUBLISH me", "LD505");
	BAD("PUBLISH me Level every=0ms", "LD505");
	BAD("PUBLISH me Level each=1s", "LD505");
	BAD("PUBLISH me Level bus=a", "LD542");
	BAD("PUBLISH me Level bus=z", "LD530");
	BAD("BUS q peer interface=lo\nPUBLISH me Level", "LD542: \"PUBLISH\" needs bus=");
	BAD("BUS q peer interface=lo group=10.1.2.3", "LD505: \"group=10.1.2.3\" is not understood; write it like group=239.192.20.1:20020");
	BAD("BUS q peer interface=lo group=tank", "LD505");
	BAD("BUS q peer interface=lo group=240.0.0.1", "LD505");
	BAD("BUS q peer interface=lo group=[ff02::1]:5", "LD505");
}

#define N10 "n123456789"
#define N60 N10 N10 N10 N10 N10 N10
#define N240 N60 N60 N60 N60

static bool publishes(const char *line)
{
	struct bench b;
	char text[800];
	bool good;

	snprintf(text, sizeof(text), "BOARD \"x\"\nBUS yard peer interface=eth0\n%s\n", line);
	bench_begin(&b);
	good = bench_map(&b, text) && b.map.net->publish_count == 1;
	bench_end(&b);
	return good;
}

/* What a datagram of boards cannot carry is an error of the map. */
static void test_long_names(void)
{
	CHECK(publishes("PUBLISH " N60 "abc Level"));
	CHECK(publishes("PUBLISH me " N240 N10 "abcde"));
	BAD("PUBLISH " N60 "abcd Level", "\" is too long: the name of a board has at most 63 bytes");
	BAD("PUBLISH me Level," N240 N10 "abcdef", "LD501");
	BAD("%IW0 peer from=" N60 "abcd name=y", "test.io:5:1: error LD873");
	BAD("%IW0 peer from=x name=" N240 N10 "abcdef", "LD505");
	READS("%IW0 peer from=" N60 "abc name=y", "%IW0 peer INT " N60 "abc y bus2");
}

/* Lines of other boards in a map without their network: what to write. */
static void test_no_network(void)
{
	static const char *const line[] = { "%IW120 peer from=pump-house name=Level", "PUBLISH me Level" };

	for (int i = 0; i < 2; i++) {
		struct bench b;
		char text[200], got[400] = "";

		snprintf(text, sizeof(text), "BOARD \"x\"\n%s\n", line[i]);
		bench_begin(&b);
		CHECK(!bench_map(&b, text) && b.diags.errors == 1);
		diag_print(&b.diags.diag[0], got, sizeof(got));
		CHECK_AS(strstr(got, "LD542") && strstr(got, "needs a line BUS yard peer interface=eth0 above it"), got);
		bench_end(&b);
	}
}

/* All lines are read, whatever is wrong with one; none of it is kept. */
static void test_all_lines(void)
{
	struct bench b;

	bench_begin(&b);
	CHECK(!bench_map(&b, "BOARD \"x\"\nBUS b modbus-rtu\n%AIW0 iio\nMODULE\nWINDOW w\nPUBLISH p\n"
			 "%AIW2 sim\n%AIW2 sim\n"));
	CHECK(b.diags.errors == 6 && b.diags.diag[5].line == 8);
	bench_end(&b);
}

/* Any piece of a good map gives points or errors, and never both. */
static void test_pieces(void)
{
	static const char whole[] = "BOARD \"x\"\nBUS a modbus-rtu port=/dev/ttyS1 baud=9600\n"
		"SERVE s modbus-tcp listen=[::1]:502 unit=3\nWINDOW s coil=0..7 %QX0.0 read-write\n"
		"BUS p peer interface=lo group=239.1.1.1:5\nPUBLISH me A,B, C every=1s bus=p\n"
		"DEVICE a unit=1 read-registers=9 write-coils=2 gap=0 together\nMODULE M di=3 coil=7\n%XIB0..2 module bus=a unit=1 type=M substitute=hold\n"
		"%AIW0 iio device=\"d e\" channel=voltage0 range=-5..5 at -10V..10mV limits=-11V..1V\n"
		"%IX9.0..10.2 modbus bus=a unit=1 input-register=3 bit=15 ask=M\n%IW0 peer bus=p from=x name=y\n"
		"%IX8.0 modbus bus=a unit=1 input-register=3 threshold=5 hysteresis=2\n%IB7 quality of=%IW0..2\n";
	bool good = true;

	for (size_t from = 0; from < sizeof(whole) - 1; from += 1 + from % 3)
		for (size_t len = 1; from + len < sizeof(whole); len += 1 + len % 7) {
			struct bench b;
			char text[sizeof(whole) + 12];
			bool read;

			snprintf(text, sizeof(text), "BOARD \"x\"\n%.*s", (int)len, whole + from);
			bench_begin(&b);
			read = bench_map(&b, from ? text : text + 10);
			good = good && (read ? !b.diags.errors : b.diags.errors > 0);
			bench_end(&b);
		}
	CHECK(good);
}

static void test_units(void)
{
	CHECK_TEXT(io_unit_word(UNIT_NONE), "");
	CHECK_TEXT(io_unit_word(UNIT_VOLT), "V");
	CHECK_TEXT(io_unit_word(UNIT_CELSIUS), "\302\260C");
	CHECK_TEXT(io_unit_word(UNIT_OHM), "Ohm");
	CHECK_TEXT(io_unit_word((enum io_unit)(UNIT_OHM + 1)), "");
	CHECK_TEXT(io_unit_word((enum io_unit)-1), "");
}

int main(void)
{
	test_units();
	test_analog();
	test_modbus();
	test_quality();
	test_modules();
	test_net();
	test_bad_points();
	test_bad_groups();
	test_bad_modules();
	test_bad_nets();
	test_bad_devices();
	test_long_names();
	test_no_network();
	test_all_lines();
	test_pieces();
	return tap_done();
}
