// SPDX-License-Identifier: LGPL-2.1-or-later
// Writes the test models, the malformed files and ground_truth.json into a folder, and renews the tables of its README.
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <stdexcept>

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <Standard_Failure.hxx>

#include "catalogue.h"
#include "exchange.h"
#include "ground_truth.h"
#include "malformed.h"
#include "readme.h"

int main(int argc, char** argv) {
    using namespace umbilic::models;
    if (argc != 2) {
        std::cerr << "usage: generate_models FOLDER\n";
        return 2;
    }
    try {
        // OpenCASCADE reports every transfer on standard output otherwise.
        Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
        const std::filesystem::path folder = argv[1];
        std::filesystem::create_directories(folder);
        const Catalogue catalogue = build_catalogue();
        nlohmann::ordered_json truth = {{"schema", "umbilic.models/1"}};
        std::map<std::string, nlohmann::ordered_json> measured;
        for (const Model& model : catalogue.models) {
            write_cad(model.shape, model.part, folder / model.file);
            measured[model.file] = measure(model, folder / model.file);
            truth["models"].push_back(measured[model.file]);
            std::cout << model.file << '\n';
        }
        for (const Pair& pair : catalogue.pairs)
            truth["pairs"].push_back(describe(pair, measured.at(pair.original), measured.at(pair.suspect)));
        truth["malformed"] = write_malformed(folder);
        std::ofstream file{folder / "ground_truth.json"};
        file << truth.dump(1) << '\n';
        if (!file.flush()) throw std::runtime_error("cannot write ground_truth.json");
        update_readme(folder / "README.md", truth);
        return 0;
    } catch (const Standard_Failure& error) {  // no std::exception before OpenCASCADE 7.8
        std::cerr << "generate_models: OpenCASCADE: " << error << '\n';
        return EXIT_FAILURE;
    } catch (const std::exception& error) {
        std::cerr << "generate_models: " << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
