#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# map_words.t - each word of hal/map_words.def, each driver, module and unit is in the documents and in the
# messages that list them. `ladder io --words` prints each option, and reads it again.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use Test::More;

chdir dirname(abs_path(__FILE__)) . '/..' or die;
my $build = $ENV{BUILD} // 'build';
my $ladder = $ENV{LADDER} // "$build/ladder";
my $folder = tempdir(CLEANUP => 1);

sub slurp {
	my ($path) = @_;
	open my $file, '<:raw', $path or die "$path: $!";
	local $/;
	return <$file>;
}

my $rows = slurp('hal/map_words.def');
my $field = slurp('docs/field.md');
my $docs = $field . slurp('docs/boards.md') . slurp('docs/modbus.md') . slurp('docs/peer.md');
my $diag = slurp('runtime/engine/diag.def');
my $said = `$ladder io --words`;
is($?, 0, 'ladder io --words');

# Words in backticks: `device=` or `device=ads1115 …`, `active-low`.
sub told {
	my ($word, $value) = @_;
	return $docs =~ /`[^`\n]*\b\Q$word\E=/ if $value;
	return $docs =~ /`[^`\n]*(?<![\w-])\Q$word\E(?![\w=-])/;
}

my %word;
while ($rows =~ /^MAP_(?:WORD|ALSO)\((\w+), "([^"]+)", (true|false)\)/gm) {
	my ($id, $text, $value) = ($1, $2, $3 eq 'true');
	$word{$text} = $id;
	ok(told($text, $value), "$text is in the documents");
	ok($said =~ /^\Q$text\E@{[$value ? '=' : '\s']}/m, "$text is in ladder io --words");
}
cmp_ok(scalar keys %word, '>', 60, 'words were read');

my ($options) = $diag =~ /^DIAG\(IO_OPTION,.*"LD504",.*known are (.*?)"\)/m;
while ($rows =~ /^CHIP_OPTION\(\w+, "([^"]+)", \w+, (true|false)/gm) {
	my ($text, $value) = ($1, $2 eq 'true');
	my $behind = $value ? '=' : '(?![\w=-])';
	ok($options =~ /(?<![\w-])\Q$text\E$behind/, "LD504 lists $text");
}
my ($drivers) = $diag =~ /^#else\nDIAG\(IO_DRIVER,.*"LD503",.*write (.*?)"\)/m;
my $known = slurp('hal/drivers.def');
for my $id ($known =~ /^DRIVER\((\w+)\)/gm) {
	ok($drivers =~ /\b$id\b/, "LD503 lists $id");
	ok($docs =~ /`[^`\n]*\b$id\b/, "$id is in the documents");
}
my ($types) = $diag =~ /^DIAG\(IO_MODULE,.*"LD537",.*write type=(.*?), or/m;
my $modules = slurp('hal/modules.def');
while ($modules =~ /^MODULE\((\w+), (\d+), (\d+), (\d+), (\d+)\)/gm) {
	my ($id, $di, $dq, $ai) = ($1, $2, $3, $4);
	ok($types =~ /\b$id\b/, "LD537 lists $id");
	ok($field =~ /^\| `$id` \| $di \| $dq \| $ai \|$/m, "$id is in the documents with its inputs and outputs");
}
my $units = slurp('hal/units.def');
my ($listed) = $field =~ /Units are (.*?)\. Without a unit/;
for my $unit ($units =~ /^UNIT(?:_ALSO)?\(\w+, "([A-Za-z%]+)"/gm) {
	ok($listed =~ /(?<!\w)\Q$unit\E(?!\w)/, "$unit is in the documents");
}

# Each form that is printed can be read: of all kinds of lines it belongs to, no option is unknown.
sub first_form { return $_[0] =~ s/(?: or |, ).*//r }
my $lines = 0;
for my $row (split /\n/, $said) {
	my ($form, $where) = $row =~ /^(\S.{38}\S?)\s+(\S.*)$/ or next;
	$form = first_form($form =~ s/\s+$//r);
	next if $form eq 'option';
	my @where = $where =~ /^(?:BUS|SERVE)/ ? split(/, /, $where) : split(/ /, $where =~ s/ \(.*//r);
	for my $of (@where) {
		my $output = $where =~ /\(outputs\)/;
		my $bit = $of eq 'gpio' || ($of eq 'sim' && $where =~ /gpio/);
		my $address = $output ? ($bit ? '%QX0.0' : '%AQW0') : $bit ? '%IX0.0' : '%AIW0';
		my $line = $of =~ /^(?:BUS|SERVE) / ? $of =~ s/ / x /r . " $form" :
			$of =~ /^[A-Z]+$/ ? "$of x $form" : "$address $of $form";
		open my $file, '>', "$folder/one.io" or die;
		print $file "BOARD \"x\"\n$line\n";
		close $file;
		my $why = `$ladder io $folder/one.io 2>&1`;
		ok($why !~ /LD504|LD528|LD541/, "$line") or diag $why;
		$lines++;
	}
}
cmp_ok($lines, '>', 100, 'lines were read');
ok(system("$ladder io --words x.io 2>/dev/null") >> 8 == 2, 'with a map: a wrong call');
done_testing;
