/* SPDX-License-Identifier: MIT
 *
 * test_retain - retained values as bytes and back: by name and type, in two slots, cut
 * at each byte, with each bit inverted. The result is a complete copy or none.
 */
#include "engine/scan/retain.h"
#include "tests/unit/rig.h"

#include "engine/base/digest.h"

static const char source[] =
	"VAR_GLOBAL RETAIN\n"
	"  Count : DINT;\n"
	"  Level : REAL := 1.5;\n"
	"  On    : BOOL;\n"
	"  Delay : TON;\n"
	"  Mark AT %MX3.2 : BOOL;\n"
	"  Wide AT %MD8 : DWORD;\n"
	"  Label : STRING[9];\n"
	"  Short : STRING[6] := 'abcdef';\n"
	"END_VAR\n"
	"VAR_GLOBAL\n  Lost : DINT;\nEND_VAR\n"
	"VAR_GLOBAL RETAIN CONSTANT\n  Fix : INT := 3;\nEND_VAR\n"
	"PROGRAM Main LD\nVAR RETAIN\n  Count : TIME;\nEND_VAR\n"
	"RUNG\n  | NO I0 | TON Delay PT:=T#1s | COIL On |\n"
	"RUNG\n  | NO I1 | COIL Mark |\n"
	"RUNG\n  | NO Mark | [ Wide := 16#01020304 ] | [ Count := T#5ms ] |\n"
	"END_PROGRAM\n";

/* The same, edited: Level gone, On now INT, Delay a TOF, Mark without address,
 * Extra new; names in other letters and another order, areas of other sizes. */
static const char edited[] =
	"VAR_GLOBAL RETAIN\n"
	"  EXTRA : INT := 9;\n"
	"  Mark  : BOOL;\n"
	"  COUNT : DINT;\n"
	"  On    : INT := 4;\n"
	"  Delay : TOF;\n"
	"  Wide AT %MD12000 : DWORD;\n"
	"  Label : STRING[30];\n"
	"  Short : STRING[5] := 'xy';\n"
	"END_VAR\n"
	"CONFIGURATION Sizes\n  AREA I 1;\n  AREA M 16384;\nEND_CONFIGURATION\n"
	"PROGRAM Main LD\nVAR RETAIN\n  Count : TIME;\nEND_VAR\n"
	"RUNG\n  | NO I0 | TOF Delay PT:=T#1s | COIL Mark |\n"
	"RUNG\n  | NO I1 | [ On := Extra ] | [ Wide := 16#01020304 ] | [ Count := T#5ms ] |\n"
	"END_PROGRAM\n";

/* What instances store, in blocks of @size values and of type @last. */
#define STORES(size, last) \
	"VAR RETAIN\n  Parcels : FIFO;\n  Mean : AVERAGE;\n  Trays : " last ";\n" \
	"  Line : Belt;\nEND_VAR\n" \
	"VAR\n  Weight AT %ID4 : DINT;\nEND_VAR\n" \
	"FUNCTION_BLOCK Belt LD\nVAR_INPUT\n  Add : BOOL;\nEND_VAR\n" \
	"VAR\n  Own : FIFO;\nEND_VAR\n" \
	"RUNG\n  | NO Add | FIFO Own IN:=7 |\nEND_FUNCTION_BLOCK\n" \
	"PROGRAM Main LD\n" \
	"RUNG\n  | NO %IX0.0 | FIFO Parcels IN:=Weight SIZE:=" size " |\n" \
	"  | NO %IX0.1 | .POP |\n" \
	"RUNG\n  | NO %IX0.2 | AVERAGE Mean IN:=3.0 N:=4 |\n" \
	"RUNG\n  | NO %IX0.0 | " last " Trays |\n  | NO %IX0.1 | .POP |\n" \
	"RUNG\n  | NO %IX0.0 | Belt Line |\nEND_PROGRAM\n"
static const char stores[] = STORES("8", "LIFO");
static const char fewer_stores[] = STORES("3", "LIFO_REAL");

struct bench {
	struct rig rig;
	struct arena arena;
	struct retain retain;
	uint8_t *copy;
};

static void open_bench(struct bench *bench, const char *text)
{
	rig_open(&bench->rig, text, false);
	arena_init(&bench->arena);
	if (!CHECK(bench->rig.good && retain_plan(&bench->retain,
			&bench->rig.resource.image, &bench->arena)))
		abort();
	bench->copy = arena_alloc(&bench->arena, bench->retain.copy_size);
}

static void close_bench(struct bench *bench)
{
	arena_free(&bench->arena);
	rig_close(&bench->rig);
}

/* Sets Label to the digits of @value, or of seven times an odd @value. */
static void set_text(struct rig *rig, int64_t value)
{
	enum { ROOM = 12 };
	struct iec_string *text = calloc(1, sizeof(*text) + ROOM);

	if (!text)
		abort();
	text->capacity = ROOM;
	text->length = (uint16_t)snprintf(text->text, ROOM, "%lld",
					  (long long)value * (value & 1 ? 7 : 1));
	image_set(&rig->resource.image, rig_at(rig, "Label"),
		  (union iec_value){ .s = text });
	free(text);
}

static bool has_text(struct rig *rig, int64_t value)
{
	const struct iec_string *text = image_get(&rig->resource.image,
						  rig_at(rig, "Label")).s;
	char want[24];

	snprintf(want, sizeof(want), "%lld", (long long)value * (value & 1 ? 7 : 1));
	return text->length == strlen(want) &&
	       memcmp(text->text, want, text->length) == 0;
}

static void set_values(struct rig *rig, int64_t value)
{
	union iec_value half = { .r = (double)value / 2 };

	rig_set(rig, "Count", value);
	image_set(&rig->resource.image, rig_at(rig, "Level"), half);
	rig_set(rig, "On", value & 1);
	rig_set(rig, "Delay.ET", value * 1000);
	rig_set(rig, "Mark", value >> 1 & 1);
	rig_set(rig, "Wide", value * 3);
	rig_set(rig, "Main.Count", value * 7);
	set_text(rig, value);
	rig_set(rig, "Lost", value);
}

static bool has_values(struct rig *rig, int64_t value)
{
	return rig_get(rig, "Count") == value &&
	       rig_real(rig, "Level") == (double)value / 2 &&
	       rig_get(rig, "On") == (value & 1) &&
	       rig_get(rig, "Delay.ET") == value * 1000 &&
	       rig_get(rig, "Mark") == (value >> 1 & 1) &&
	       rig_get(rig, "Wide") == value * 3 &&
	       rig_get(rig, "Main.Count") == value * 7 && has_text(rig, value);
}

/* A copy of the rig's values into slot @slot of @file. */
static uint32_t write_slot(struct bench *bench, uint8_t *file, int slot,
			   uint32_t seq, uint32_t flags)
{
	uint32_t room = retain_room(bench->retain.payload_size), size;

	retain_copy(&bench->retain, &bench->rig.resource.image, bench->copy);
	retain_fill(&bench->retain, bench->copy, (int64_t)seq * 1000);
	size = retain_seal(&bench->retain, seq, flags, room);
	memcpy(file + (size_t)slot * room, bench->retain.slot, size);
	return size;
}

/* Takes all records of the copy; counts each result. */
static void take_all(struct bench *bench, const struct retain_found *found,
		     int fate[3])
{
	struct retain_record record;
	uint32_t at = RETAIN_HEAD;

	memset(fate, 0, 3 * sizeof(*fate));
	retain_copy(&bench->retain, &bench->rig.resource.image, bench->copy);
	while (retain_next(found->payload, found->len, &at, &record))
		fate[retain_take(&bench->retain, &record, bench->copy)]++;
	retain_put(&bench->retain, &bench->rig.resource.image, bench->copy);
}

static bool names_are(const struct bench *bench, const char *want)
{
	char got[400];
	size_t len = 0;

	for (int i = 0; i < bench->retain.count; i++) {
		struct retain_record r = retain_record_of(&bench->retain, i);

		len += (size_t)snprintf(got + len, sizeof(got) - len,
					"%.*s:%.*s ", (int)r.name_len, r.name,
					(int)r.type_len, r.type);
	}
	if (strcmp(got, want) != 0)
		printf("# %s\n", got);
	return strcmp(got, want) == 0;
}

static void plans(void)
{
	struct bench b;

	open_bench(&b, source);
	CHECK(names_are(&b, "Count:DINT Level:REAL On:BOOL Delay.IN:TON.BOOL "
		"Delay.Q:TON.BOOL Delay.PT:TON.TIME Delay.ET:TON.TIME "
		"Delay.start:TON.TIME Delay.running:TON.BOOL Mark:BOOL "
		"Wide:DWORD Label:STRING Short:STRING Main.Count:TIME "));
	CHECK(b.retain.loose_count == 2 && b.retain.bytes == 4 + 4 + 1 + 2 +
	      8 * 3 + 1 + 1 + 4 + 8 + 4 + 12 + 4 + 8);
	close_bench(&b);
	open_bench(&b, "PROGRAM Main LD\nRUNG\n  | NO I0 | COIL Q0 |\n"
		   "END_PROGRAM\n");
	CHECK(b.retain.count == 0 && b.retain.payload_size == RETAIN_HEAD);
	close_bench(&b);
	open_bench(&b, "TYPE\n  Link : STRUCT\n    To : REF_TO INT;\n    Last : LWORD;\n  END_STRUCT;\nEND_TYPE\n"
		   "VAR RETAIN\n  Count : INT;\n  Pt : REF_TO INT;\n  Many : ARRAY[1..4] OF REF_TO INT;\n"
		   "  First : Link;\nEND_VAR\nPROGRAM Main ST\n  Pt := REF(Count);\n  Many[1] := First.To;\n"
		   "END_PROGRAM\n");
	CHECK_AS(names_are(&b, "Count:INT First.Last:LWORD "), "no pointer is retained");
	close_bench(&b);
}

/* Values at their limits: the retained value is that of image_get(). */
static void copies(void)
{
	struct bench b;
	struct rig *rig = &b.rig;

	open_bench(&b, source);
	set_values(rig, 7);
	retain_copy(&b.retain, &rig->resource.image, b.copy);
	set_values(rig, 100);
	retain_put(&b.retain, &rig->resource.image, b.copy);
	CHECK(has_values(rig, 7) && rig_get(rig, "Lost") == 100);
	resource_start(&rig->resource);
	CHECK(rig_get(rig, "Count") == 0 && rig_real(rig, "Level") == 1.5);
	rig_set(rig, "%IX0.1", 1);
	CHECK(rig_scan(rig) && rig_get(rig, "Mark") == 1);
	retain_copy(&b.retain, &rig->resource.image, b.copy);
	rig_set(rig, "%IX0.1", 0);
	rig_scan(rig);
	CHECK(rig_get(rig, "Mark") == 0 && rig_get(rig, "Wide") == 0x01020304);
	retain_put(&b.retain, &rig->resource.image, b.copy);
	CHECK(rig_get(rig, "Mark") == 1 && rig_get(rig, "Wide") == 0x01020304);
	set_values(rig, 9);
	CHECK(retain_start(&rig->resource) && has_values(rig, 9));
	CHECK(rig_get(rig, "Lost") == 0 && rig->resource.scans == 0);
	CHECK(rig_scan(rig) && rig_get(rig, "SYS_WARM") == 1 &&
	      rig_get(rig, "SYS_RETAIN_LOST") == 0);
	rig->resource.retain_lost = rig->resource.retain_old_copy = true;
	CHECK(rig_scan(rig) && rig_get(rig, "SYS_RETAIN_LOST") == 1 &&
	      rig_get(rig, "SYS_RETAIN_OLD_COPY") == 1);
	resource_start(&rig->resource);
	CHECK(rig_scan(rig) && rig_get(rig, "SYS_WARM") == 0 &&
	      rig_get(rig, "SYS_RETAIN_LOST") == 0 &&
	      rig_get(rig, "SYS_RETAIN_OLD_COPY") == 0);
	close_bench(&b);
}

/* Which copy @file gives: 1 or 2 by its values, 0 none; -1: a mix. */
static int which(struct bench *b, const uint8_t *file, size_t len,
		 struct retain_found *found)
{
	int fate[3];

	retain_find(file, len, found);
	if (found->best < 0)
		return 0;
	set_values(&b->rig, 55);
	take_all(b, found, fate);
	if (fate[RETAIN_KEPT] != b->retain.count)
		return -1;
	if (has_values(&b->rig, 1001))
		return 1;
	return has_values(&b->rig, 2002) ? 2 : -1;
}

static void round_trip(struct bench *b, uint8_t *file, size_t len)
{
	struct retain_found found;

	CHECK(which(b, file, len, &found) == 2 && found.seq == 8 && found.fits);
	CHECK(!found.old_copy && retain_clock(found.payload) == 8000);
	retain_find(file, 0, &found);
	CHECK(found.best < 0 && found.state[0] == RETAIN_BAD);
	memset(file, 0, len);
	retain_find(file, len, &found);
	CHECK(found.best < 0 && found.state[0] == RETAIN_EMPTY);
	set_values(&b->rig, 1001);
	write_slot(b, file, 0, 1, RETAIN_FIRST);
	CHECK(which(b, file, len, &found) == 1 && !found.old_copy);
	set_values(&b->rig, 1001);
	write_slot(b, file, 0, 1, 0);
	CHECK_AS(which(b, file, len, &found) == 1 && found.old_copy,
		 "a copy that is not the first, beside an empty slot, counts as old");
}

/* The file is cut at each byte: the first copy is found as long as it is complete. */
static void cut_file(struct bench *b, const uint8_t *file, size_t len,
		     uint32_t size, uint32_t room)
{
	struct retain_found found;
	int mixed = 0, wrong = 0, unsaid = 0;

	for (size_t cut = 0; cut < len; cut++) {
		uint8_t *part = malloc(cut + 1);
		int got, want = cut >= room + size ? 2 : cut >= size ? 1 : 0;

		memcpy(part, file, cut);
		got = which(b, part, cut, &found);
		mixed += got < 0;
		wrong += got != want;
		unsaid += got == 1 && !found.old_copy;
		free(part);
	}
	CHECK_AS(!mixed && !wrong && !unsaid,
		 "a file cut at any byte gives its last complete copy");
}

/* A write stops at each byte of the older copy: the new one is found up to there. */
static void cut_write(struct bench *b, const uint8_t *file, size_t len,
		      uint32_t size)
{
	uint8_t *torn = malloc(len), *next = malloc(len);
	struct retain_found found;
	int mixed = 0, wrong = 0, unsaid = 0;

	memcpy(next, file, len);
	set_values(&b->rig, 1001);
	write_slot(b, next, 0, 9, 0);
	for (uint32_t cut = 0; cut <= size; cut++) {
		memcpy(torn, file, len);
		memcpy(torn, next, cut);
		int got = which(b, torn, len, &found);

		mixed += got < 0;
		wrong += got != (found.seq == 9 ? 1 : 2);
		unsaid += found.seq == 8 && !found.old_copy &&
			  memcmp(torn, file, len) != 0;
	}
	CHECK_AS(!mixed && !wrong && !unsaid,
		 "a write cut at any byte leaves a complete copy");
	CHECK(found.seq == 9 && !found.old_copy);
	free(torn);
	free(next);
}

static void turn_bits(struct bench *b, uint8_t *file, size_t len, uint32_t size,
		      uint32_t room)
{
	struct retain_found found;
	int mixed = 0, wrong = 0, unsaid = 0;

	for (uint32_t bit = 0; bit < size * 16; bit++) {
		uint32_t at = bit / 8 < size ? bit / 8 : room + bit / 8 - size;
		int got;

		file[at] ^= (uint8_t)(1u << bit % 8);
		got = which(b, file, len, &found);
		mixed += got < 0;
		wrong += got != (at < room ? 2 : 1);
		unsaid += !found.old_copy;
		file[at] ^= (uint8_t)(1u << bit % 8);
	}
	CHECK_AS(!mixed && !wrong && !unsaid, "a copy with any bit changed is not used");
	file[40] ^= 1;
	file[room + 40] ^= 1;
	CHECK(which(b, file, len, &found) == 0 && !found.fits);
	file[40] ^= 1;
	file[room + 40] ^= 1;
}

static void keeps_two_slots(void)
{
	struct bench b;
	struct retain_found found;
	uint8_t *file;
	uint32_t room, size;

	open_bench(&b, source);
	room = retain_room(b.retain.payload_size);
	file = calloc(2, room);
	set_values(&b.rig, 1001);
	size = write_slot(&b, file, 0, 7, 0);
	set_values(&b.rig, 2002);
	write_slot(&b, file, 1, 8, 0);
	cut_file(&b, file, 2 * (size_t)room, size, room);
	cut_write(&b, file, 2 * (size_t)room, size);
	turn_bits(&b, file, 2 * (size_t)room, size, room);
	set_values(&b.rig, 1001);
	write_slot(&b, file, 0, UINT32_MAX, 0);
	CHECK_AS(which(&b, file, 2 * (size_t)room, &found) == 2,
		 "number 8 is newer than the highest number");
	set_values(&b.rig, 2002);
	write_slot(&b, file, 1, UINT32_MAX - 1, 0);
	CHECK_AS(which(&b, file, 2 * (size_t)room, &found) == 1,
		 "the highest number is newer than the one before it");
	set_values(&b.rig, 1001);
	write_slot(&b, file, 0, 7, 0);
	set_values(&b.rig, 2002);
	write_slot(&b, file, 1, 8, 0);
	round_trip(&b, file, 2 * (size_t)room);
	free(file);
	close_bench(&b);
}

static void fits_edited(void)
{
	struct bench b, after;
	struct retain_found found;
	struct rig *rig = &after.rig;
	uint32_t room;
	uint8_t *file;
	int fate[3];

	open_bench(&b, source);
	open_bench(&after, edited);
	room = retain_room(b.retain.payload_size);
	file = calloc(2, room);
	set_values(&b.rig, 1003);
	write_slot(&b, file, 0, 1, RETAIN_FIRST);
	retain_find(file, 2 * (size_t)room, &found);
	take_all(&after, &found, fate);
	CHECK(rig_get(rig, "Count") == 1003 && rig_get(rig, "Mark") == 1);
	CHECK(rig_get(rig, "Wide") == 3009 && rig_get(rig, "Main.Count") == 7021);
	CHECK_AS(has_text(rig, 1003), "a text is kept in a variable with more room");
	CHECK_AS(image_get(&rig->resource.image, rig_at(rig, "Short")).s->length == 2,
		 "a text longer than its new room is lost, not cut");
	CHECK(rig_get(rig, "On") == 4 && rig_get(rig, "Extra") == 9);
	CHECK_AS(rig_get(rig, "Delay.ET") == 0, "ET of a TON is not kept for a TOF");
	CHECK(fate[RETAIN_KEPT] == 5 && fate[RETAIN_NO_NAME] == 1 &&
	      fate[RETAIN_NO_TYPE] == 8);
	CHECK(!after.retain.taken[0] && after.retain.taken[1]);
	free(file);
	close_bench(&b);
	close_bench(&after);
}

/* One more value in each store, or one less. */
static void step_stores(struct rig *rig, bool in, int64_t value)
{
	rig_set(rig, "Weight", value);
	rig_set(rig, "%IX0.0", in);
	rig_set(rig, "%IX0.1", !in);
	rig_scan(rig);
	rig_set(rig, "%IX0.0", 0);
	rig_set(rig, "%IX0.1", 0);
	rig_scan(rig);
}

static void keeps_stores(void)
{
	struct bench b, after;
	struct retain_found found;
	struct rig *rig = &after.rig;
	uint32_t room;
	uint8_t *file;
	int fate[3];

	open_bench(&b, stores);
	rig_set(&b.rig, "%IX0.2", 1);
	for (int i = 1; i <= 70; i++) /* past the end of the ring; four are left */
		step_stores(&b.rig, i <= 5 || i % 2, 100 + i);
	rig_set(&b.rig, "%IX0.2", 0);
	step_stores(&b.rig, true, 171);
	room = retain_room(b.retain.payload_size);
	file = calloc(2, room);
	write_slot(&b, file, 0, 1, RETAIN_FIRST);
	retain_find(file, 2 * (size_t)room, &found);
	step_stores(&b.rig, false, 0);
	int64_t first = rig_get(&b.rig, "Parcels.OUT");

	open_bench(&after, fewer_stores);
	take_all(&after, &found, fate);
	CHECK_AS(rig_get(rig, "Parcels.COUNT") == 5 && rig_get(rig, "Line.Own.COUNT") > 30,
		 "the counts of FIFOs are kept");
	step_stores(rig, true, 999);
	CHECK_AS(rig_get(rig, "Parcels.COUNT") == 5 && rig_get(rig, "Parcels.FULL") == 1,
		 "a smaller SIZE keeps all stored values and takes no new one");
	step_stores(rig, false, 0);
	CHECK_AS(first > 100 && rig_get(rig, "Parcels.OUT") == first,
		 "POP gives the oldest value first");
	for (int i = 0; i < 4; i++)
		step_stores(rig, false, 0);
	CHECK_AS(rig_get(rig, "Parcels.OUT") == 171 && rig_get(rig, "Parcels.EMPTY") == 1,
		 "POP gives the newest value last");
	CHECK_AS(rig_get(rig, "Trays.COUNT") == 0 && fate[RETAIN_NO_TYPE] == 15,
		 "all values of a store of another type are lost");
	rig_set(rig, "%IX0.2", 1);
	rig_scan(rig);
	CHECK_AS(rig_real(rig, "Mean.OUT") == 3.0 && rig_get(rig, "Mean.COUNT") == 4,
		 "AVERAGE goes on with its old values");
	free(file);
	close_bench(&b);
	close_bench(&after);
}

/* Forged inner state of instances, with a correct checksum: a scan stays within the
 * instance (the sanitizers check that). */
static void believes_no_store(void)
{
	struct bench b;
	uint32_t seed = 1;
	int odd = 0;

	open_bench(&b, stores);
	for (int round = 0; round < 2000; round++) {
		for (uint32_t i = 0; i < b.retain.copy_size; i++) {
			seed = seed * 1103515245u + 12345u;
			b.copy[i] = (uint8_t)(seed >> 24);
		}
		retain_put(&b.retain, &b.rig.resource.image, b.copy);
		rig_set(&b.rig, "%IX0.2", round & 1);
		step_stores(&b.rig, round & 2, round);
		odd += rig_get(&b.rig, "Parcels.COUNT") > 64 ||
		       rig_get(&b.rig, "Mean.COUNT") > 64;
	}
	CHECK(!odd);
	close_bench(&b);
}

/* Forged bytes with a correct checksum. */
static void believes_nothing(void)
{
	struct bench b;
	struct retain_found found;
	const struct iec_string *text;
	uint32_t room, size, crc, seed = 1;
	uint8_t *file;
	int fate[3], refused = 0, odd = 0;

	open_bench(&b, source);
	room = retain_room(b.retain.payload_size);
	file = calloc(2, room);
	for (int round = 0; round < 20000; round++) {
		size = write_slot(&b, file, 0, 1, RETAIN_FIRST);
		for (int i = 0; i < 3; i++) {
			seed = seed * 1103515245u + 12345u;
			file[(seed >> 8) % (size - 4)] =
				(uint8_t)(seed >> 24);
		}
		crc = digest_crc32c(0, file, size - 4);
		memcpy(file + size - 4, &crc, sizeof(crc));
		retain_find(file, 2 * (size_t)room, &found);
		if (found.best < 0) {
			refused++;
			continue;
		}
		take_all(&b, &found, fate);
		text = image_get(&b.rig.resource.image,
				 rig_at(&b.rig, "Label")).s;
		odd += text->capacity != 9 || text->length > 9;
		odd += retain_clock(found.payload) < 0 ||
		       rig_get(&b.rig, "On") > 1;
	}
	CHECK(refused > 0 && refused < 20000 && !odd);
	free(file);
	close_bench(&b);
}

int main(void)
{
	plans();
	copies();
	keeps_two_slots();
	fits_edited();
	keeps_stores();
	believes_no_store();
	believes_nothing();
	return tap_done();
}
