*** Settings ***
Documentation     What SymboSLAM's ontology must know, in sentences for people who know the matter and no OWL.
...               `make acceptance` runs them and writes build/acceptance/report.html. Below the sentences
...               stands every competency question of manifest.ttl as a test of its own, by its subject.
Metadata          Questions    requirements.md
Library           symboslam.reasoning.questions.keywords.Keywords    each=${EACH}    reasoner=${REASONER}
Suite Setup       Load the ontology

*** Variables ***
${EACH}           yes
${REASONER}       yes

*** Test Cases ***
A house speaks for a residential area
    [Tags]    What features say
    House should indicate Residential with strength 0.9
    House should not indicate Industrial

Buildings stay, animals come and go
    [Tags]    What features say
    House should stay in its place
    Cat should come and go

A feature is never an environment
    [Tags]    What may not be said
    Data should be refused    ${CURDIR}/errors/err-01.ttl

Nothing stays and moves at once
    [Tags]    What may not be said
    Data should be refused    ${CURDIR}/errors/err-02.ttl

The map of the project's own town may be said
    [Tags]    What may be said
    Data should be accepted    ${CURDIR}/data/town.ttl

We know what a house indicates, how strongly and why
    [Tags]    What features say
    Ask question    env-01
    The answer should mention    Residential    0.9
    The answer should be as expected

Every part of the questions holds
    [Template]    All questions about "${group}" should pass
    [Tags]    Parts
    What a feature says
    Telling types apart
    Segments and their types
    A robot and its way
    Control
