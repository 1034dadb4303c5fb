/* SPDX-License-Identifier: MIT
 *
 * test_own_words - words of a project beside those of the catalogue.
 */
#include "engine/model/words.h"
#include "engine/base/limits.h"
#include "tests/tap.h"

#include <stdio.h>

static struct arena arena;
static struct word_table table;

static enum word find(const char *name)
{
	return words_find(&table, name, strlen(name));
}

static enum word add(const char *name)
{
	return words_add(&table, (struct word_row){
		.word = name, .kind = WORD_FN, .place = PLACE_BOX });
}

static void begins_with_the_catalogue(void)
{
	words_init(&table, &arena);
	CHECK(find("ton") == FB_TON);
	CHECK(find("Motor") == WORD_COUNT);
	CHECK(find("") == WORD_COUNT);
	CHECK(words_row(&table, FB_TON) == word_row(FB_TON));
	CHECK(words_row(&table, WORD_COUNT) == word_row(ELEM_EMPTY));
	CHECK(!words_own(&table, FB_TON) && !words_own(&table, WORD_FIRST_OWN));
	CHECK(words_row(&table, WORD_FIRST_OWN)->place == PLACE_BOX);
}

static void keeps_its_own(void)
{
	enum word motor = add("Motor"), valve = add("Valve");

	CHECK(motor == WORD_FIRST_OWN && word_is_own(motor));
	CHECK(!word_is_own(FB_TON) && !word_is_own(WORD_COUNT));
	CHECK(find("MOTOR") == motor && find("valve") == valve);
	CHECK(find("Moto") == WORD_COUNT && find("TON") == FB_TON);
	CHECK_TEXT(words_row(&table, motor)->word, "Motor");
	words_own(&table, valve)->size = 24;
	CHECK(words_row(&table, valve)->size == 24);
	CHECK(add("motor") != motor && find("Motor") == motor);
}

static void keeps_many(void)
{
	static char name[LIMIT_OWN_WORDS][24];
	const struct word_row *first = words_row(&table, WORD_FIRST_OWN);
	bool found = true;
	enum word last = WORD_COUNT;

	for (int i = 0; table.count < LIMIT_OWN_WORDS; i++) {
		snprintf(name[i], sizeof(name[i]), "Word%d", i);
		last = add(name[i]);
		found &= find(name[i]) == last;
	}
	CHECK(found && last < WORD_MOST);
	CHECK(find("word17") != WORD_COUNT);
	CHECK(words_row(&table, WORD_FIRST_OWN) == first);
	CHECK(add("OneMore") == WORD_COUNT && find("OneMore") == WORD_COUNT);
}

int main(void)
{
	arena_init(&arena);
	begins_with_the_catalogue();
	keeps_its_own();
	keeps_many();
	arena_free(&arena);
	return tap_done();
}
