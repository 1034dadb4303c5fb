#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# plcopen_bad.t - PLCopen XML that somebody has damaged, or made to do harm: it is refused with a place in it, or
# read with a line of the report, and nothing outside of the file is ever opened. What is damaged in a rung
# drawn like that, in a chart, in types: one change at a time of a project that is good.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use IO::Socket::INET;
use POSIX qw(mkfifo);
use Test::More;
use lib abs_path(dirname(__FILE__));
use Files;

my $tests = abs_path(dirname(__FILE__));
my $build = abs_path($ENV{BUILD} // "$tests/../build");
my $ladder = abs_path($ENV{LADDER} // "$build/ladder");
my $folder = tempdir(CLEANUP => 1);
chdir $folder or die;

spew('probe.xml', '<project xmlns="http://www.plcopen.org/xml/tc6_0201"><types/></project>');
plan skip_all => 'built without libxml2' if `$ladder check probe.xml 2>&1` =~ /LD040/;

my $good = slurp("$tests/plcopen_bad.xml");

# What import says, and the rung file. It ends by itself, with 0 or 1, and with 1 there is an error in this file.
sub imported {
	my ($xml, $what) = @_;
	spew('bad.xml', $xml);
	unlink 'bad.rung';
	my $said = `timeout 60 $ladder import bad.xml -o bad.rung 2>&1`;
	my $status = $?;
	my $error = $said =~ /^bad\.xml(?::\d+)*: (?:[^\n]*: )?error LD\d+/m;
	ok(($status == 0 && !$error) || ($status == 256 && $error), "$what: it is read or refused") or diag("status $status\n$said");
	return ($said, slurp('bad.rung') // '');
}
sub refused { my ($xml, $code, $what) = @_; like((imported($xml, $what))[0], qr/error $code/, "$what: $code") }
sub changed { my ($was, $is) = @_; my $xml = $good =~ s/$was/$is/r; die "nothing is $was" if $xml eq $good; return $xml }

{
	my ($said, $rung) = imported($good, 'the project itself');
	like($said, qr/0 lost/, 'the project itself: all of it is taken') or diag($said);
}

# ---- entities and other files ----
spew('secret.txt', 'BOOL; (* the-secret *)');
spew('secret.rung', "RUNGBOARD 1\nPROGRAM TheSecret LD\nEND_PROGRAM\n");
mkfifo('waits', 0600); # who opens it, waits
my $server = IO::Socket::INET->new(Listen => 5, LocalAddr => '127.0.0.1', Blocking => 0);
my $port = $server ? $server->sockport : 9;
my ($declaration, $rest) = $good =~ /^(<\?xml.*?\?>\n)(.*)$/s;
sub with_entities { my ($subset, $use) = @_; return $declaration . $subset . ($rest =~ s/productName="[^"]*"/productName="$use"/r) }
my @bomb = map { my $next = $_ + 1; "<!ENTITY e$_ \"" . ("&e$next;" x 10) . "\">\n" } 1 .. 12;
my %entities = (
	'entities in entities' => ['<!DOCTYPE project [<!ENTITY e13 "boom">' . join('', reverse @bomb) . ']>', '&e1;'],
	'one long entity many times' => ['<!DOCTYPE project [<!ENTITY a "' . 'x' x 100_000 . '">]>', '&a;' x 5000],
	'an entity that holds itself' => ['<!DOCTYPE project [<!ENTITY a "&a;">]>', '&a;'],
	'an entity of a file' => ["<!DOCTYPE project [<!ENTITY a SYSTEM \"file://$folder/secret.txt\">]>", '&a;'],
	'an entity of a file that waits' => ["<!DOCTYPE project [<!ENTITY a SYSTEM \"file://$folder/waits\">]>", '&a;'],
	'an entity of a server' => ["<!DOCTYPE project [<!ENTITY a SYSTEM \"http://127.0.0.1:$port/a\">]>", '&a;'],
	'a document type of a server' => ["<!DOCTYPE project SYSTEM \"http://127.0.0.1:$port/a.dtd\">", 'P'],
	'a document type that waits' => ["<!DOCTYPE project SYSTEM \"file://$folder/waits\">", 'P'],
	'a public document type' => ["<!DOCTYPE project PUBLIC \"-//X//Y\" \"http://127.0.0.1:$port/a.dtd\">", 'P'],
	'an entity of parameters' => ["<!DOCTYPE project [<!ENTITY % p SYSTEM \"http://127.0.0.1:$port/p\"> %p;]>", 'P'],
	'one of parameters that waits' => ["<!DOCTYPE project [<!ENTITY % p SYSTEM \"file://$folder/waits\"> %p;]>", 'P'],
	'a notation' => ["<!DOCTYPE project [<!NOTATION n SYSTEM \"http://127.0.0.1:$port/n\"><!ENTITY a SYSTEM \"http://127.0.0.1:$port/a\" NDATA n>]>", 'P'],
	'default attributes' => ['<!DOCTYPE project [<!ATTLIST contact negated CDATA "true">]>', 'P'],
	'a style sheet' => ["<?xml-stylesheet href=\"http://127.0.0.1:$port/s.css\"?>", 'P'],
);
for my $what (sort keys %entities) {
	my ($said, $rung) = imported(with_entities(@{$entities{$what}}), $what);
	unlike($said . $rung, qr/the-secret|boom/, "$what: nothing of another file");
	like($said, qr/error LD(?:74[0-3]|044)/, "$what: refused") if $entities{$what}[1] =~ /&/;
}
for my $more ("<xi:include xmlns:xi=\"http://www.w3.org/2001/XInclude\" href=\"file://$folder/secret.txt\"/>", '<addData><data name="x" handleUnknown="discard"><any/></data></addData>') {
	my ($said) = imported($good =~ s{</project>}{$more</project>}r, 'an element of another namespace');
	like($said, qr/lost: the element/, 'an element of another namespace: it is told');
}
imported($good =~ s{<project }{<project xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:schemaLocation="http://127.0.0.1:$port/x http://127.0.0.1:$port/y.xsd" }r, 'a schema of a server');
ok(!$server || !$server->accept, 'nobody was asked over the network');

# The text of an export names no other file, whatever somebody writes there.
spew('own.rung', "RUNGBOARD 1\nVAR\n  A : BOOL;\nEND_VAR\nPROGRAM Main LD\nRUNG\n  | NO A | COIL A |\nEND_PROGRAM\n");
system("$ladder export --as plcopen own.rung -o own.xml 2>trouble");
my $own = slurp('own.xml');
like($own, qr/urn:rungboard:text/, 'an export has its text beside it');
for my $line ("INCLUDE \"secret.rung\"\n", "(* c *) INCLUDE\n\n\"secret.rung\"\n", "USES \"secret.rung\"\n", "  include \"secret.rung\"\n") {
	my ($said, $rung) = imported($own =~ s/(<!\[CDATA\[)(\nVAR)/$1\n$line$2/r, 'a text that names a file');
	unlike($rung, qr/INCLUDE|USES|TheSecret/i, 'a text that names a file is not read');
	like($said, qr/lost: the text beside the drawing/, 'and that is told');
}
for ([qr/digest="\w+"/, 'digest="0000000000000000"'], [qr/digest="\w+"/, 'digest="x"'], [qr/ digest="\w+"/, ''], [qr/<part[^>]*>.*<\/part>/s, ''], [qr/<part>/, '<piece>']) {
	imported($own =~ s/$_->[0]/$_->[1]/r =~ s/<piece>(.*?)<\/part>/<piece>$1<\/piece>/sr, "an export with $_->[1]");
}
like((imported($own =~ s/negated="false"|<variable>A/<variable>B/r, 'an export whose drawing was changed'))[0], qr/changed: .*Main was changed/, 'is read from its drawing');

# ---- bytes ----
imported("\xef\xbb\xbf$good", 'a mark of the order of bytes');
imported($good =~ s/utf-8/ISO-8859-1/r =~ s/companyName="[^"]*"/companyName="M\xfcller"/r, 'Latin letters');
imported($good =~ s/utf-8/UTF-99/r, 'an unknown code of letters');
imported(join('', map { "$_\0" } split //, $good), 'sixteen bits a letter');
imported("\xff\xfe" . join('', map { "$_\0" } split //, $good =~ s/utf-8/UTF-16/r), 'the same with its mark');
refused($good =~ s/companyName="/companyName="\xc3\x28/r, 'LD74[01]', 'letters that are none');
refused($good =~ s/companyName="/companyName="\0/r, 'LD74[01]', 'a zero byte');
refused($good =~ s/companyName="/companyName="&#0;/r, 'LD74[01]', 'a zero as a reference');
refused($good . $good, 'LD74[01]', 'two projects in one file');
refused($good . '<a/>', 'LD74[01]', 'an element behind the end');
imported($good . "<!-- end -->\n\n", 'a comment behind the end');
refused('<project xmlns="http://www.plcopen.org/xml/tc6_0201">' . '<a>' x 100_000, 'LD74[0-3]', 'a hundred thousand elements in one another');
refused('<project xmlns="http://www.plcopen.org/xml/tc6_0201"><a ' . join(' ', map { "a$_=\"\"" } 1 .. 200_000) . '>', 'LD74[0-3]', 'two hundred thousand attributes');
imported($good =~ s/name="Main"/'name="' . 'M' x 200_000 . '"'/er, 'a name of 200,000 letters');
{
	my $list = sub { "<data name=\"x\" handleUnknown=\"discard\"><globalVars name=\"$_[0]\"><variable name=\"Gone\"><type><INT/></type></variable></globalVars></data>" };
	my $with = sub { my $add = '<addData>' . $list->(@_) . '</addData>'; $good =~ s{</project>}{$add</project>}r };
	for my $length (256, 1000, 1_000_000) {
		my ($said, $rung) = imported($with->('A' x $length), "a list of global variables with a name of $length letters");
		like($said, qr/lost: globalVars name="AAA\w+" is left out/, "$length letters: its name is left out, and that is told") or diag(substr $said, 0, 500);
		like($rung, qr/Gone : INT/, "$length letters: its variables stay");
	}
	my ($said) = imported($with->('A' x 255), 'a name of 255 letters');
	unlike($said, qr/globalVars name/, 'a name of 255 letters is one');
}
imported($good =~ s/<variable>A</'<variable>' . '(' x 100_000 . '<'/er, 'a hundred thousand parentheses');
imported($good =~ s/(<contact localId="2".*?<\/contact>\n)/$1 x 20_000/esr, 'an element twenty thousand times');

# ---- each place ----
# The end of the file at each byte: refused, with a line. Some files at once.
my @cuts = map { my $name = sprintf 'cut%05d.xml', $_; spew($name, substr $good, 0, $_); $name } 100 .. length($good) - 12;
my (%seen, @odd);
while (my @some = splice @cuts, 0, 300) {
	my $said = `timeout 300 $ladder check @some 2>&1 >quiet`;
	push @odd, "status $?" if $? != 256;
	$seen{$_}++ for $said =~ /^(cut\d+\.xml)(?::\d+)*: error LD74[01]/mg;
	push @odd, grep { !$seen{$_} } @some;
	unlink @some;
}
is("@odd", '', scalar(keys %seen) . ' cuts are refused at their line');
# Each element is left out, and each stands twice; each attribute is left out, is empty, or has another value.
my @elements;
push @elements, [$-[0], $+[0] - $-[0]] while $good =~ /<(\w+)\b[^<>]*(?<!\/)>[^<]*<\/\1>|<\w+\b[^<>]*\/>/g;
my @attributes;
push @attributes, [$-[1], $+[1] - $-[1]] while $good =~ /\s\w+="([^"]*)"/g;
my @made;
for my $e (@elements) {
	push @made, substr($good, 0, $e->[0]) . substr($good, $e->[0] + $e->[1]);
	push @made, substr($good, 0, $e->[0]) . substr($good, $e->[0], $e->[1]) x 2 . substr($good, $e->[0] + $e->[1]);
}
for my $a (@attributes) {
	push @made, substr($good, 0, $a->[0]) . $_ . substr($good, $a->[0] + $a->[1]) for '', '-1', '99999999999999999999', 'x y', "&#10;(* ';";
}
my $count = @made;
my @names = map { my $name = sprintf 'made%05d.xml', $_; spew($name, $made[$_]); $name } 0 .. $#made;
@odd = ();
while (my @some = splice @names, 0, 100) {
	my $said = `timeout 300 $ladder check @some 2>&1 >quiet`;
	push @odd, "status $? of $some[0] …" if $? != 0 && $? != 256;
	# Each is told by its name at the end: good, or how many errors.
	for my $name (@some) {
		push @odd, $name if $said !~ /^\Q$name\E(?::\d+)*: /m && $said !~ /^\Q$name\E/m;
	}
}
is("@odd", '', "$count changes of one element or attribute are answered");
unlink glob 'made*.xml';

# ---- numbers of elements ----
# They come into names of the text: of a box with lines, of a wire.
{
	my $box = '<contact localId="70"><position x="0" y="0"/><connectionPointIn><connection refLocalId="LEFT"/></connectionPointIn><connectionPointOut/><variable>A</variable></contact>'
		. '<block localId="ID" typeName="EXECUTE"><position x="0" y="0"/><inputVariables><variable formalParameter="EN"><connectionPointIn><connection refLocalId="70"/></connectionPointIn></variable></inputVariables><inOutVariables/>'
		. '<outputVariables><variable formalParameter="ENO"><connectionPointOut/></variable></outputVariables><addData><data name="http://www.3s-software.com/plcopenxml/stcode" handleUnknown="implementation"><STCode xmlns="">;</STCode></data></addData></block>';
	my $sum = '<inVariable localId="71"><position x="0" y="0"/><connectionPointOut/><expression>A</expression></inVariable>'
		. '<block localId="ID" typeName="AND"><position x="0" y="0"/><inputVariables><variable formalParameter="IN1"><connectionPointIn><connection refLocalId="71"/></connectionPointIn></variable><variable formalParameter="IN2"><connectionPointIn><connection refLocalId="71"/></connectionPointIn></variable></inputVariables><inOutVariables/>'
		. '<outputVariables><variable formalParameter="OUT"><connectionPointOut/></variable></outputVariables></block>'
		. join '', map { "<outVariable localId=\"$_\"><position x=\"0\" y=\"0\"/><connectionPointIn><connection refLocalId=\"ID\"/></connectionPointIn><expression>A</expression></outVariable>" } 72, 73;
	for my $id ('7 x', '-7', '+8', '7 | COIL A |&#10;RUNG&#10;  | ', '7:&#10;END_EXECUTE', ' 7', '9' x 300, '7(* ', '', 'x', '007') {
		my $body = sub { (my $inner = $_[1]) =~ s/ID/$id/g; $inner =~ s/LEFT/700/; my $rail = $_[0] eq 'LD' ? '<leftPowerRail localId="700"><position x="0" y="0"/><connectionPointOut formalParameter="none"/></leftPowerRail>' : '';
			"<pou name=\"Hostile\" pouType=\"program\"><interface><localVars><variable name=\"A\"><type><BOOL/></type></variable></localVars></interface><body><$_[0]>$rail$inner</$_[0]></body></pou>" };
		for my $kind (['LD', $box, qr/^RUNG\n  \| NO A \| EXECUTE (Box\w+) \|\n  EXECUTE \1:\n\s*;\n  END_EXECUTE\n/m], ['FBD', $sum, qr/^  AND_\w+ := AND\(A, A\)$/m]) {
			my $pou = $body->(@$kind);
			my ($said, $rung) = imported($good =~ s{</pous>}{$pou</pous>}r, "$kind->[0] with the number \"$id\"");
			next if $kind->[0] eq 'FBD' && $id eq '';
			$rung =~ s/^.*?(?=PROGRAM Hostile)//s;
			$rung =~ s/^END_PROGRAM\n\K.*//ms;
			like($rung, $kind->[2], "$kind->[0] with the number \"$id\": a name is what stands there") or diag($said);
			is(() = $rung =~ /^(?:RUNG|NETWORK)/mg, 1, "$kind->[0] with the number \"$id\": and nothing else");
		}
	}
}

# ---- circles, and what leads nowhere ----
my $in = sub { "<connectionPointIn><connection refLocalId=\"$_[0]\"/></connectionPointIn>" };
for ([qr/(<contact localId="2".*?refLocalId=)"\d+"/s, '"2"', 'a contact that leads to itself', 'LD748'],
	[qr/(<contact localId="2".*?refLocalId=)"\d+"/s, '"3"', 'two contacts in a circle', 'LD748'],
	[qr/(<block localId="6".*?refLocalId=)"\d+"/s, '"6"', 'a block that leads to itself', '(?:LD748|lost|changed|taken)'],
	[qr/(<coil localId="4".*?refLocalId=)"\d+"/s, '"4"', 'a coil that leads to itself', 'LD748'],
	[qr/(<contact localId="2".*?refLocalId=)"\d+"/s, '"77"', 'a contact from nowhere', 'LD747'],
	[qr/(<coil localId="4".*?refLocalId=)"\d+"/s, '"77"', 'a coil from nowhere', 'LD747'],
	[qr/(<block localId="6".*?refLocalId=)"\d+"/s, '"77"', 'a block from nowhere', 'LD747'],
	[qr/(<outVariable localId="25".*?refLocalId=)"\d+"/s, '"77"', 'a variable from nowhere', 'LD747'],
	[qr/(<transition localId="33".*?refLocalId=)"\d+"/s, '"77"', 'a transition from nowhere', 'LD747'],
	[qr/(<step localId="34".*?refLocalId=)"\d+"/s, '"77"', 'a step from nowhere', 'LD747'],
	[qr/(<jumpStep localId="36".*?refLocalId=)"\d+"/s, '"77"', 'a jump from nowhere', 'LD747'],
	[qr/(<actionBlock localId="37".*?refLocalId=)"\d+"/s, '"77"', 'actions from nowhere', 'LD747'],
	[qr/(<selectionDivergence localId="32".*?refLocalId=)"\d+"/s, '"32"', 'a choice that leads to itself', '(?:lost|error)'],
	[qr/(<jumpStep localId="36"[^>]*targetName=)"\w+"/, '"Nowhere"', 'a jump to a step that is not there', '(?:lost|changed|error)'],
	[qr/(<contact localId=)"2"/, '"3"', 'two elements of one number', 'LD746'],
	[qr/(<inVariable localId=)"22"/, '"23"', 'two elements of one number in a diagram', 'LD746'],
	[qr/(<step localId="34" name=)"\w+"/, '"One"', 'two steps of one name', '(?:lost|changed|error)'],
	[qr/(<connection refLocalId="6" formalParameter=)"Q"/, '"QQ"', 'an output that the block does not have', 'LD750'],
	[qr/(<continuation localId="27" name=)"\w+"/, '"Other"', 'a continuation without its connector', '(?:lost|changed|error)'],
	[qr/(<block localId="6" typeName=)"TON"/, '"NOBODY"', 'a block in a ladder of a type that is not known', 'changed: .*NOBODY'],
	[qr/(<block localId="24" typeName=)"AND"/, '"NOBODY"', 'a block in a diagram of a type that is not known', 'changed: .*NOBODY'],
	[qr/(<block localId="39" typeName=)"AND"/, '"NOBODY"', 'a block before a transition of a type that is not known', '(?:changed|lost|error).*NOBODY'],
	[qr/(<variable name="Wait"><type><derived name=)"TON"/, '"NOBODY"', 'a variable of a type that is not known', 'lost: .*NOBODY'],
	[qr/(<pou name=)"Flow"/, '"Main"', 'two programs of one name', 'error'],
	[qr/(<variable name=)"B"/, '"A"', 'two variables of one name', 'error'],
	[qr/(<dataType name=)"Deep"/, '"Part"', 'two types of one name', 'error'],
	[qr/(<variable name="Inner"><type><derived name=)"Part"/, '"Deep"', 'a structure that holds itself', 'error'],
	[qr/(<dimension lower="1" upper=)"3"/, '"999999999999"', 'an array without end', 'error'],
	[qr/(<task name="Often"[^>]*priority=)"\d+"/, '"99999999999"', 'a priority without end', '(?:error|changed)'],
	[qr/(<task name="Often"[^>]*interval=)"[^"]*"/, '"P1Y"', 'an interval of a year', 'error'],
	[qr/(<pouInstance name="Run1" typeName=)"Main"/, '"Nobody"', 'an instance of a program that is not there', 'error'],
	[qr/(<part member="x" n=|<pou name="Flow" pouType=)"\w+"/, '"class"', 'a kind of POU that is not known', '(?:lost|error)'],
	[qr/(<project xmlns=)"[^"]*"/, '"http://www.plcopen.org/xml/tc6_0202"', 'a version that is newer', 'LD745'],
	[qr/(<project xmlns=)"[^"]*"/, '"http://www.plcopen.org/xml/tc7"', 'another family', 'LD745']) {
	my ($where, $value, $what, $expected) = @$_;
	my $xml = $good =~ s/$where/$1$value/r;
	ok($xml ne $good, "$what: there is such a place") or next;
	my ($said) = imported($xml, $what);
	like($said, qr/^bad\.xml:\d+: .*$expected/m, "$what: $expected") or diag($said);
}
for my $version (qw(tc6.xsd tc6_0100 tc6_0101 tc6_0200 tc6_0201)) {
	my ($said) = imported($good =~ s/tc6_0201/$version/r, $version);
	like($said, qr/0 lost/, "$version is read");
}
done_testing;
