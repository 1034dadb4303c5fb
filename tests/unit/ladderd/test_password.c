/* SPDX-License-Identifier: MIT
 *
 * test_password - who waits after a wrong password, and how long. The clock and crypt(3) are those
 * of this test.
 */
#include "ladderd/password.h"
#include "tests/tap.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define SECOND INT64_C(1000000000)

static bool no_memory;

bool crypt_can(void)
{
	return true;
}

bool crypt_make(const char *text, char *out)
{
	snprintf(out, PASSWORD_HASH, "%s", text);
	return true;
}

enum crypt_end crypt_compare(const char *text, const char *hash)
{
	return no_memory ? CRYPT_NO_MEMORY : strcmp(text, hash) == 0 ? CRYPT_FITS : CRYPT_DIFFERS;
}

static struct password password;
static int64_t now_ns;
static char detail[64];

static enum refusal attempt(uint32_t who, const char *text)
{
	return password_check(&password, who, text, now_ns, detail, sizeof(detail));
}

static void begin(void)
{
	memset(&password, 0, sizeof(password));
	password.set = true;
	snprintf(password.hash, sizeof(password.hash), "right");
	now_ns = 1000 * SECOND;
	no_memory = false;
}

static void test_each_wrong_one_doubles_the_time(void)
{
	begin();
	for (int i = 0; i < 9; i++) {
		const int64_t wait_s = i < 6 ? INT64_C(1) << i : 64;

		CHECK(attempt(7, "wrong") == REFUSAL_WRONG);
		now_ns += wait_s * SECOND - 1;
		CHECK(attempt(7, "right") == REFUSAL_WAIT);
		CHECK_TEXT(detail, "1");
		now_ns++;
	}
	CHECK(attempt(7, "right") == REFUSAL_NONE);
	CHECK(attempt(7, "wrong") == REFUSAL_WRONG);
	now_ns += SECOND;
	CHECK_AS(attempt(7, "right") == REFUSAL_NONE, "the right one ends the row of wrong ones");
}

static void test_nobody_makes_another_wait(void)
{
	begin();
	for (int i = 0; i < 100; i++) {
		CHECK(attempt(7, "wrong") == (i ? REFUSAL_WAIT : REFUSAL_WRONG));
		CHECK(attempt(8, "right") == REFUSAL_NONE);
	}
	CHECK(attempt(7, "right") == REFUSAL_WAIT);
}

/* More users than rows: the one whose time is over longest ago is forgotten; as long as all wait,
 * the next one waits, too. */
static void test_the_table_is_bounded(void)
{
	begin();
	for (uint32_t who = 0; who < PASSWORD_GUESSERS; who++)
		CHECK(attempt(who, "wrong") == REFUSAL_WRONG);
	CHECK(attempt(99, "wrong") == REFUSAL_WAIT);
	now_ns += SECOND;
	for (uint32_t who = 1; who < PASSWORD_GUESSERS; who++)
		CHECK(attempt(who, "wrong") == REFUSAL_WRONG);
	CHECK(attempt(99, "right") == REFUSAL_NONE);
	CHECK(attempt(1, "right") == REFUSAL_WAIT);
	now_ns += 2 * SECOND;
	CHECK(attempt(1, "right") == REFUSAL_NONE);
}

static void test_no_memory_is_no_try(void)
{
	begin();
	no_memory = true;
	for (int i = 0; i < 5; i++)
		CHECK(attempt(7, "wrong") == REFUSAL_MEMORY);
	no_memory = false;
	CHECK(attempt(7, "right") == REFUSAL_NONE);
}

int main(void)
{
	test_each_wrong_one_doubles_the_time();
	test_nobody_makes_another_wait();
	test_the_table_is_bounded();
	test_no_memory_is_no_try();
	return tap_done();
}
